// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Threads that keep cores busy while something is measured.

#include "flyball/runtime/result.h"

#include <atomic>
#include <thread>
#include <vector>

namespace flyball {

/// Keeps cores busy with arithmetic while it lives.
class BusyCores {
 public:
  BusyCores() = default;
  BusyCores(const BusyCores&) = delete;
  BusyCores& operator=(const BusyCores&) = delete;
  ~BusyCores();

  /// One more. @error `unavailable`: no thread may run on this core.
  Status take(int cpu);

 private:
  void work();

  std::vector<std::thread> threads_{};
  std::atomic<bool> ends_{};
  std::atomic<double> last_{};  ///< Read by nobody; without it there would be nothing to compute.
};

}  // namespace flyball
