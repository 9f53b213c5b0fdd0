// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/clock_meter.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <ctime>
#include <system_error>

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace flyball {
namespace {

/// With the kernel's cycles: the task's clock runs there too.
int open_cycle_counter() {
  perf_event_attr event{};
  event.size = sizeof event;
  event.type = PERF_TYPE_HARDWARE;
  event.config = PERF_COUNT_HW_CPU_CYCLES;
  event.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  event.inherit = 1;
  event.exclude_hv = 1;
  return static_cast<int>(syscall(SYS_perf_event_open, &event, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

struct Count {
  std::uint64_t cycles{};
  std::uint64_t enabled_ns{};
  std::uint64_t running_ns{};  ///< Of tasks while the counter counted: their task-clock.
};

std::optional<Count> read_counter(int counter) {
  Count count;
  if (read(counter, &count, sizeof count) != static_cast<ssize_t>(sizeof count)) {
    return std::nullopt;
  }
  return count;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr int additions_of_round = 1000;
constexpr int rounds = 200;

/// Instructions and not C++, so that no compiler, at no level, adds up what the processor shall add
/// one by one. The summand is a register: processors since 2021 fold constants away.
void add_in_a_chain() {
  unsigned long sum = 0;
  const unsigned long summand = 3;
  for (int round = 0; round < rounds; ++round) {
#if defined(__x86_64__) || defined(__i386__)
    asm volatile(".rept 1000\n\tadd %1, %0\n\t.endr" : "+r"(sum) : "r"(summand));  // NOLINT
#elif defined(__aarch64__) || defined(__arm__)
    asm volatile(".rept 1000\n\tadd %0, %0, %1\n\t.endr" : "+r"(sum) : "r"(summand));  // NOLINT
#else
    for (int i = 0; i < additions_of_round; ++i) {
      sum += summand;
      asm volatile("" : "+r"(sum));  // NOLINT: the compiler must not multiply
    }
#endif
  }
}

}  // namespace

ClockMeter::ClockMeter(double cycles_per_addition)
    : counter_{open_cycle_counter()}, cycles_per_addition_{cycles_per_addition} {
  const int number = errno;
  const auto count = counter_ >= 0 ? read_counter(counter_) : std::nullopt;
  if (count) {
    source_ = "cycles over task-clock";
    last_cycles_ = static_cast<double>(count->cycles);
    last_s_ = 1e-9 * static_cast<double>(count->running_ns);
    return;
  }
  if (counter_ >= 0) {
    close(counter_);
    counter_ = -1;
  }
  const bool is_forbidden = number == EACCES || number == EPERM;
  source_ = "additions (no counter of cycles: " +
            (is_forbidden ? std::system_category().message(number) +
                                "; try: sysctl kernel.perf_event_paranoid=1)"
                          : std::string{"this processor or virtual machine shows none)"});
}

ClockMeter::~ClockMeter() {
  if (counter_ >= 0) {
    close(counter_);
  }
}

std::optional<Hertz> ClockMeter::measure() {
  if (counter_ < 0) {
    return clock_by_additions(cycles_per_addition_);
  }
  const auto count = read_counter(counter_);
  if (!count) {
    return std::nullopt;
  }
  const double cycles = static_cast<double>(count->cycles) - last_cycles_;
  const double busy_s = 1e-9 * static_cast<double>(count->running_ns) - last_s_;
  if (busy_s < 1e-3) {
    return std::nullopt;
  }
  last_cycles_ += cycles;
  last_s_ += busy_s;
  return cycles > 0.0 ? std::optional{Hertz{cycles / busy_s}} : std::nullopt;
}

Hertz clock_by_additions(double cycles_per_addition) {
  double shortest_s = 1e9;
  for (int run = 0; run < 3; ++run) {
    const double begin_s = thread_seconds();
    add_in_a_chain();
    shortest_s = std::min(shortest_s, thread_seconds() - begin_s);
  }
  constexpr double additions = static_cast<double>(additions_of_round) * rounds;
  return Hertz{cycles_per_addition * additions / std::max(shortest_s, 1e-9)};
}

}  // namespace flyball
