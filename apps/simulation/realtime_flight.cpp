// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/realtime_flight.h"

#include "flyball/runtime/realtime/cpus.h"

namespace flyball {

MakeExecutor in_real_time(const RealtimeSettings& settings) {
  return [settings](const Graph& graph, const Platform& /*platform*/, EventQueue& /*queue*/,
                    const OperatingPoint& start) {
    RealtimeSettings chosen = settings;
    if (chosen.cpus.empty()) {
      chosen.cpus = usable_cpus();
      if (chosen.cpus.size() > 1) {
        // Where it fails, the simulator runs where the system likes.
        (void)bind_thread(0, {chosen.cpus.back()});
        chosen.cpus.pop_back();
      }
    }
    return std::make_unique<RealtimeExecutor>(graph, start, chosen);
  };
}

}  // namespace flyball
