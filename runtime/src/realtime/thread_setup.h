// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a thread of the real-time executor asks of the operating system, and what it was granted.

#include <optional>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/types.h>

namespace flyball {

struct ThreadWish {
  std::string name{};                  ///< At most 15 characters, for `top` and debuggers.
  std::optional<int> fifo_priority{};  ///< Empty: ordinary scheduling with `nice`.
  int nice{};                          ///< Absolute.
  bool prefault_stack{};
};

/// For the calling thread. Each wish is read back; one sentence for each that was not granted, with
/// what would help.
[[nodiscard]] std::vector<std::string> set_up_thread(const ThreadWish& wish);

/// From where on SCHED_FIFO can be had.
struct FifoGrant {
  std::optional<int> from{};  ///< Empty: not at all.
  std::string note{};         ///< Where it is not what was asked for: what would help.
};

/// The highest priority up to `from` to which `above` more can be added. Tries on a thread of its
/// own.
[[nodiscard]] FifoGrant grantable_fifo(int from, int above);

/// What the kernel withholds from real-time threads that never sleep, as a sentence; empty where it
/// withholds nothing. `folder` is where its settings stand.
[[nodiscard]] std::optional<std::string> real_time_throttle(
    const std::string& folder = "/proc/sys/kernel");

/// How many bytes this process may lock; empty: all of its memory.
[[nodiscard]] std::optional<rlim_t> memory_lock_limit();

/// Keeps what the process touches from now on in memory; a sentence if that failed. Under a limit
/// only what the process has now is kept: whatever it asks for later would count with its whole
/// size, each stack with megabytes, and be refused.
[[nodiscard]] std::optional<std::string> lock_process_memory();

/// The nice value that the process was started with, of its first thread.
[[nodiscard]] int process_nice();

/// Of the calling thread, as the kernel counts it.
[[nodiscard]] pid_t thread_id();

}  // namespace flyball
