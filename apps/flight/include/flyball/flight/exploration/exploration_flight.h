// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Takes off, flies from view to view as the explorer answers, flies home and lands: what 3-D
/// mapping and search and rescue have in common.

#include "flyball/flight/legs.h"
#include "flyball/flight/navigation/navigation_nodes.h"
#include "flyball/flight/perception/perception_nodes.h"

#include <cstdint>
#include <optional>

namespace flyball {

struct ExploreQuery {
  std::uint64_t id{};
  ExploreRequest request{};
};

struct ExploreAnswer {
  std::uint64_t id{};
  ExploreStep step{};
};

/// On a link: views that were had and places that were not reached, beside the members of fixed
/// size.
[[nodiscard]] inline double wire_bytes(const ExploreQuery& query) {
  return static_cast<double>(sizeof(ExploreQuery) + query.request.taken.size() * sizeof(Viewpoint) +
                             query.request.unreachable_W.size() * sizeof(Vec3));
}

/// The request to the explorer from a viewpoint, with field of view, body and limits of the
/// mission.
[[nodiscard]] ExploreRequest explore_request(const Brief& brief, const Viewpoint& from);

/// @error `invalid_input`: the world has no volume to explore.
[[nodiscard]] Status check_volume(const Site& site);

class ExplorationFlight {
 public:
  enum class State : std::uint8_t {
    exploring,  ///< From before take-off until `go_home`.
    exhausted,  ///< No view is left that shows anything.
    homing,
    landed,
  };

  /// Adds the node `explore` and all nodes of perception and navigation.
  ExplorationFlight(Graph& graph, const FlightParts& parts);

  /// Adds to the spec of the mission's node which topics it reads and writes.
  void declare(NodeSpec& spec) const;
  /// Advances the flight by one step; called by the mission's node.
  void step(JobContext& job);
  /// It explores, and the navigator has heard the last command.
  [[nodiscard]] bool takes_view(JobContext& job) const;
  /// Flies to this view next, instead of the one that it was about to have. Needs `takes_view`.
  void fly_to(JobContext& job, const Viewpoint& view);
  /// Somebody may stand behind where the camera looked: flies to all views once more, turned away
  /// from how it had them. False when that has been done, or no view was had.
  [[nodiscard]] bool look_again();
  /// The mission is done with exploring: flies home and lands, unless it does already.
  void go_home(JobContext& job);

  [[nodiscard]] const PerceptionTopics& perception() const { return perception_; }
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] int views() const { return static_cast<int>(taken_.size()); }

 private:
  enum class Stage : std::uint8_t { ready, climbing, mapping, thinking, flying, turning, landing };

  void advance(JobContext& job, const PoseEstimate& pose);
  void take_off(JobContext& job, const PoseEstimate& pose);
  void await_map(MissionTime now);
  void think(JobContext& job);
  void fly_to_next_view_again(JobContext& job, const Vec3& from_W);
  void take_answer(JobContext& job);
  void watch_flight(JobContext& job);
  void watch_turn(JobContext& job);
  void give_up_view(JobContext& job);
  void cross_off_view();
  void land(JobContext& job);

  void add_explore(Graph& graph);
  [[nodiscard]] Vec3 above_start_W() const;

  FlightParts parts_;
  PerceptionTopics perception_;
  Guidance guidance_;
  Legs legs_;
  Service<ExploreQuery, ExploreAnswer> explore_{};
  State state_{State::exploring};
  Stage stage_{Stage::ready};
  MissionTime since_{};  ///< When the stage began.
  std::uint64_t asked_{};
  Viewpoint view_{};
  std::vector<Viewpoint> taken_{};
  bool looks_again_{};
  std::vector<Viewpoint> again_{};  ///< That are left then.
  std::vector<Vec3> unreachable_W_{};
};

}  // namespace flyball
