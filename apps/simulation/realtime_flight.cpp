// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/realtime_flight.h"

#include "flyball/runtime/realtime/cpus.h"

#include <algorithm>
#include <vector>

namespace flyball {
namespace {

/// Before the simulator was bound to one of them: a process may fly twice.
const std::vector<int>& cpus_of_process() {
  static const std::vector<int> all = usable_cpus();
  return all;
}

}  // namespace

MakeExecutor in_real_time(const RealtimeSettings& settings) {
  return [settings](const Graph& graph, const Platform& /*platform*/, EventQueue& /*queue*/,
                    const OperatingPoint& start) {
    RealtimeSettings chosen = settings;
    const std::vector<int>& all = cpus_of_process();
    chosen.cpus = chosen.cpus.empty() ? all : chosen.cpus;
    const auto is_spare = [&chosen](int cpu) {
      return std::find(chosen.cpus.begin(), chosen.cpus.end(), cpu) == chosen.cpus.end();
    };
    const auto spare = std::find_if(all.rbegin(), all.rend(), is_spare);
    // Where it fails, the simulator runs where the system likes.
    if (spare != all.rend()) {
      (void)bind_thread(0, {*spare});
    } else if (chosen.cpus.size() > 1) {
      (void)bind_thread(0, {chosen.cpus.back()});
      chosen.cpus.pop_back();
    }
    return std::make_unique<RealtimeExecutor>(graph, start, chosen);
  };
}

}  // namespace flyball
