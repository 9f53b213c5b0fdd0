// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How the simulator and its referee take part in the mission: through topics only.

#include "flyball/flight/brief.h"
#include "flyball/flight/mission_topics.h"
#include "flyball/flight/navigation/guidance.h"
#include "flyball/flight/perception/localization_nodes.h"
#include "flyball/flight/perception/map_revision.h"
#include "flyball/runtime/event_queue.h"
#include "flyball/runtime/executor.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// Figures of the maps that were flown with, for the summary.
struct MapUses {
  std::vector<double> budget_use{};  ///< Latency over its bound, for each published map.
  std::vector<double> latency_s{};   ///< Sensor to command, for each of them.
  std::uint64_t overruns{};          ///< Maps later than their bound.
};

/// Keeps the newest message of each topic that the simulator looks at, and publishes what the
/// simulator has to say.
class MissionLink {
 public:
  /// All arguments outlive the link.
  MissionLink(std::shared_ptr<const Brief> brief,
              const Graph& graph,
              const MissionTopics& topics,
              Executor& executor,
              const EventQueue& queue);
  MissionLink(const MissionLink&) = delete;
  MissionLink& operator=(const MissionLink&) = delete;

  [[nodiscard]] const Brief& brief() const { return *brief_; }
  void log(std::string_view channel, std::vector<Field> fields);
  void event(const std::string& what) { log("event", {{"what", what}}); }
  void finish(MissionStatus status, MissionFailure failure);

  [[nodiscard]] MissionPhase phase() const { return phase_; }
  /// The end that counts; empty while the mission goes on.
  [[nodiscard]] const std::optional<MissionEnd>& outcome() const { return outcome_; }
  [[nodiscard]] const std::optional<KnobsInForce>& knobs() const { return knobs_; }
  [[nodiscard]] const std::optional<NavigatorState>& navigator() const { return navigator_; }
  [[nodiscard]] const std::optional<MapRevision>& map() const { return map_; }
  [[nodiscard]] const std::optional<LocalizationStatus>& localization() const {
    return localization_;
  }
  [[nodiscard]] const MapUses& map_uses() const { return map_uses_; }

 private:
  template <class T>
  void keep_newest(const Graph& graph, const char* name, std::optional<T>& newest);

  std::shared_ptr<const Brief> brief_;  ///< Owners: the nodes and this.
  MissionTopics topics_;
  Executor& executor_;
  const EventQueue& queue_;
  MissionPhase phase_{MissionPhase::wait};
  std::optional<MissionEnd> outcome_{};
  std::optional<KnobsInForce> knobs_{};
  std::optional<NavigatorState> navigator_{};
  std::optional<MapRevision> map_{};
  std::optional<LocalizationStatus> localization_{};
  MapUses map_uses_{};
};

}  // namespace flyball
