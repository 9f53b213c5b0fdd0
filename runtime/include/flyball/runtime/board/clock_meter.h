// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The clock that cores really run at. What the driver reports may be what was asked for, or a
/// guess (raspberrypi/linux issues 2986 and 5874).

#include "flyball/runtime/units.h"

#include <optional>
#include <string>

namespace flyball {

/// Measures by the processor's own counter of cycles where the kernel permits it, without any work
/// of its own; else by a chain of additions of which each waits for the one before.
class ClockMeter {
 public:
  /// Counts the cycles of the calling thread and of threads that it starts from now on.
  /// @param cycles_per_addition  For the chain: `BoardFile::cycles_per_addition`.
  explicit ClockMeter(double cycles_per_addition = 1.0);
  ClockMeter(const ClockMeter&) = delete;
  ClockMeter& operator=(const ClockMeter&) = delete;
  ~ClockMeter();

  /// For people: `cycles over task-clock`, or `additions`, and why not the counter.
  [[nodiscard]] const std::string& source() const { return source_; }
  /// By the counter: mean clock of the busy time since the last call; empty while there was less
  /// than a millisecond of it. By additions: the calling thread's core now.
  /// @cost  Counter: one system call. Additions: 3 times 200000 cycles of the calling thread, which
  ///        is .3 ms at 2 GHz; it does not wait.
  [[nodiscard]] std::optional<Hertz> measure();

 private:
  int counter_{-1};
  double cycles_per_addition_;
  std::string source_{};
  double last_cycles_{};
  double last_s_{};
};

/// By the chain alone; the fastest of three runs, because others only make it slower.
[[nodiscard]] Hertz clock_by_additions(double cycles_per_addition);

}  // namespace flyball
