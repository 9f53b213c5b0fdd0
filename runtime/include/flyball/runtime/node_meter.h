// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What each node of a graph takes of the computer.

#include "flyball/runtime/board.h"
#include "flyball/runtime/executor.h"

#include <mutex>
#include <vector>

namespace flyball {

/// Counts the jobs of an executor. Any thread may ask.
class NodeMeter {
 public:
  /// From now on; the meter outlives the executor's jobs.
  void connect(Executor& executor);
  [[nodiscard]] NodeUse of(int node) const;

 private:
  void add(const JobRecord& job);

  mutable std::mutex mutex_{};
  std::vector<NodeUse> nodes_{};
};

}  // namespace flyball
