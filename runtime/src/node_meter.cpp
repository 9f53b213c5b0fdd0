// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/node_meter.h"

namespace flyball {

void NodeMeter::connect(Executor& executor) {
  executor.on_job([this](const JobRecord& job) { add(job); });
}

void NodeMeter::add(const JobRecord& job) {
  const std::lock_guard lock{mutex_};
  const auto node = static_cast<std::size_t>(job.node);
  if (node >= nodes_.size()) {
    nodes_.resize(node + 1);
  }
  NodeUse& use = nodes_[node];
  use.busy_core_s += to_seconds(job.busy);
  if (!job.killed) {  // A job that was killed says nothing about how long one takes.
    use.latency = job.ended - job.released;
    use.gigacycles = to_seconds(job.busy) * job.clock.value() * 1e-9;
  }
}

NodeUse NodeMeter::of(int node) const {
  const std::lock_guard lock{mutex_};
  const auto at = static_cast<std::size_t>(node);
  return at < nodes_.size() ? nodes_[at] : NodeUse{};
}

}  // namespace flyball
