// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission
#include "simulation/mission_link.h"

#include <utility>

namespace flyball {

MissionLink::MissionLink(std::shared_ptr<const Brief> brief,
                         const Graph& graph,
                         const MissionTopics& topics,
                         Executor& executor,
                         const EventQueue& queue)
    : brief_{std::move(brief)}, topics_{topics}, executor_{executor}, queue_{queue} {
  executor.subscribe<MissionState>(topics.state,
                                   [this](const MissionState& state) { phase_ = state.phase; });
  executor.subscribe<MissionEnd>(topics.outcome, [this](const MissionEnd& end) { outcome_ = end; });
  keep_newest(graph, "knobs", knobs_);
  keep_newest(graph, "navigator", navigator_);
  keep_newest(graph, "map_revision", map_);
  keep_newest(graph, "localization", localization_);
  if (const auto uses = graph.find<MapUse>("map_use")) {
    executor.subscribe<MapUse>(*uses, [this](const MapUse& use) {
      map_uses_.budget_use.push_back(use.budget_use);
      map_uses_.latency_s.push_back(use.sensor_to_command_s);
      map_uses_.overruns += use.budget_use > 1.0 ? 1 : 0;
    });
  }
}

template <class T>
void MissionLink::keep_newest(const Graph& graph, const char* name, std::optional<T>& newest) {
  if (const auto topic = graph.find<T>(name)) {
    executor_.subscribe<T>(*topic, [&newest](const T& message) { newest = message; });
  }
}

void MissionLink::log(std::string_view channel, std::vector<Field> fields) {
  executor_.publish(topics_.log, LogRow{queue_.now(), channel, std::move(fields)});
}

void MissionLink::finish(MissionStatus status, MissionFailure failure) {
  executor_.publish(topics_.end, MissionEnd{queue_.now(), status, failure});
}

}  // namespace flyball
