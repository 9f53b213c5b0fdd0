// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A workload: builds its graph of kernels, and knows when its mission is done.

#include "flyball/runtime/graph.h"

#include <memory>
#include <string>

namespace flyball {

class MissionContext;  // see apps/src/mission_context.h

class Workload {
 public:
  Workload() = default;
  Workload(const Workload&) = delete;
  Workload& operator=(const Workload&) = delete;
  virtual ~Workload() = default;

  /// Adds its nodes. `context` outlives the workload.
  virtual void build(Graph& graph, MissionContext& context) = 0;
};

class Registry;
void register_workloads(Registry& registry);

}  // namespace flyball
