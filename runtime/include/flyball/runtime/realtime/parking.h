// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where threads sleep until another one has something for them, or until a time.

#include <atomic>
#include <chrono>
#include <climits>
#include <cstdint>
#include <ctime>
#include <optional>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace flyball {

/// An event count on a futex. Timed condition variables are avoided: with older C libraries they
/// follow the wall clock, and they were seen tens of milliseconds late where the kernel's timers
/// were not. The waiter takes a ticket, looks whether there is something to do, and waits with the
/// ticket; it does not sleep when somebody has called `wake` in between.
class Parking {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::uint32_t ticket() const { return word_.load(std::memory_order_acquire); }

  /// Returns when `wake` has been called since the ticket was taken, or it is `until`; sometimes
  /// without a reason. Looks for `spin` before it sleeps.
  void wait(std::uint32_t ticket,
            std::chrono::nanoseconds spin = {},
            std::optional<Clock::time_point> until = {}) {
    if (spin.count() > 0 && has_spun_to_a_wake(ticket, spin)) {
      return;
    }
    timespec deadline{};
    if (until) {
      const auto ns =
          std::chrono::duration_cast<std::chrono::nanoseconds>(until->time_since_epoch()).count();
      deadline.tv_sec = static_cast<std::time_t>(ns / 1'000'000'000);
      deadline.tv_nsec = static_cast<long>(ns % 1'000'000'000);
    }
    sleepers_.fetch_add(1);
    // It compares the word with the ticket by itself; an absolute time on the monotonic clock.
    syscall(SYS_futex, &word_, FUTEX_WAIT_BITSET_PRIVATE, ticket, until ? &deadline : nullptr,
            nullptr, FUTEX_BITSET_MATCH_ANY);
    sleepers_.fetch_sub(1);
  }

  /// Wakes one sleeper, or `count` of them.
  void wake(int count = 1) {
    word_.fetch_add(1);
    if (sleepers_.load() > 0) {
      syscall(SYS_futex, &word_, FUTEX_WAKE_PRIVATE, count, nullptr, nullptr, 0);
    }
  }
  void wake_all() { wake(INT_MAX); }

 private:
  [[nodiscard]] bool has_spun_to_a_wake(std::uint32_t ticket, std::chrono::nanoseconds spin) const {
    const Clock::time_point end = Clock::now() + spin;
    while (Clock::now() < end) {
      if (word_.load(std::memory_order_acquire) != ticket) {
        return true;
      }
    }
    return false;
  }

  std::atomic<std::uint32_t> word_{};
  std::atomic<int> sleepers_{};
  static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t));
};

}  // namespace flyball
