// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// CPU time of the jobs of one thread.

#include "flyball/runtime/realtime/cpu_time.h"
#include "flyball/runtime/time.h"

#include <algorithm>

namespace flyball {

/// The thread's CPU clock takes a system call, up to 2 us in a virtual machine, which is more than
/// the rest of a hop. So it is read after long jobs only; a short one counts by the clock on the
/// wall.
class CpuMeter {
 public:
  /// Of a job that has just ended after `wall`. What the executor did for it counts too, and so
  /// does what other threads did.
  [[nodiscard]] Duration job(Duration wall) { return own(wall) + take_helpers_time(); }

 private:
  [[nodiscard]] Duration own(Duration wall) {
    if (wall < short_job) {
      short_jobs_ += wall;
      return wall;
    }
    const Duration now = thread_cpu_time();
    const Duration used = now - last_ - short_jobs_;
    last_ = now;
    short_jobs_ = {};
    return std::clamp(used, Duration::zero(), wall);
  }

  static constexpr Duration short_job = std::chrono::microseconds{50};  // Chosen: 25 readings.
  Duration last_{thread_cpu_time()};
  Duration short_jobs_{};
};

}  // namespace flyball
