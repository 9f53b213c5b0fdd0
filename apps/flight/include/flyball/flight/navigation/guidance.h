// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the mission's node asks of the navigator, and what it is told.

#include "flyball/flight/navigation/path_follower.h"
#include "flyball/runtime/occupancy.h"

#include <memory>
#include <optional>
#include <variant>

namespace flyball {

/// The path is given up; the reference stands here.
struct HoverAt {
  Vec3 p_W{Vec3::Zero()};
  double yaw_rad{};
};
/// A new goal. At the place where the vehicle stops, the camera turns to the heading, if there is
/// one.
struct GoTo {
  Vec3 p_W{Vec3::Zero()};
  std::optional<double> yaw_rad{};
  /// Who asks for it has others to go to when no path to it is found.
  bool is_one_of_many{};
};
/// The goal is given up. A path that is flown is flown to its end.
struct NoGoal {};

struct GuidanceCommand {
  std::uint64_t number{};  ///< 1 is the first one.
  std::variant<HoverAt, GoTo, NoGoal> what{};
};

/// What others may know of the navigator; it publishes this with each set-point.
struct NavigatorState {
  std::uint64_t obeyed{};  ///< Number of the newest command that it has heard; 0: none.
  bool has_goal{};
  Vec3 goal_W{Vec3::Zero()};  ///< The last one, if there was any.
  bool has_arrived{};
  std::uint64_t path_number{};         ///< Another one for each path and each hover.
  std::shared_ptr<const Path> path{};  ///< Empty: the reference hovers. Owners: readers of it.
  double s_m{};                        ///< Of the reference, along the path.
  Vec3 position_W{Vec3::Zero()};       ///< Of the reference, as are the next four.
  double yaw_rad{};
  double speed_m_s{};
  double target_speed_m_s{};
  bool stands_still{true};
  bool must_hover{};  ///< The governor's fallback asks for that: no reason to give up a goal.
  double known_free_m{};
  Duration latency_bound{};  ///< On the age of a map (`MapLatency::age_bound`), in force.
  TrackingError tracking_error{};
  /// Searches without a path since one was found, and stalls since the vehicle last moved.
  int planner_failures{};
  int replans{};  ///< Since the start.
  std::uint64_t map_revision{};
  Duration map_latency{};      ///< Of that revision, from sensor to published map.
  MissionTime map_captured{};  ///< The newest frame in it.
  double map_range_m{};        ///< That it was made with; 0: there is none.
  /// The map of that revision; null: there is none. Owners: its readers.
  std::shared_ptr<const OccupancyView> map{};

  [[nodiscard]] bool has_path() const { return path && !path->empty(); }
};

/// How a published map kept to its bound on latency.
struct MapUse {
  double budget_use{};           ///< Latency over its own bound (`MapLatency::latency_bound`).
  double sensor_to_command_s{};  ///< Until the first set-point that knows the map.
};

struct GuidanceTopics {
  Topic<GuidanceCommand> command;
  Topic<NavigatorState> state;
};

/// The mission node's side of these topics.
class Guidance {
 public:
  explicit Guidance(const GuidanceTopics& topics) : topics_{topics} {}

  /// What the node that calls the members below has to declare.
  void declare(NodeSpec& spec) const;
  void hover_at(JobContext& job, const Vec3& p_W, double yaw_rad) {
    send(job, HoverAt{p_W, yaw_rad});
  }
  void go_to(JobContext& job, const Vec3& p_W) { send(job, GoTo{p_W}); }
  void go_to_view(JobContext& job, const Vec3& p_W, double yaw_rad) {
    send(job, GoTo{p_W, yaw_rad, true});
  }
  void give_up_goal(JobContext& job) { send(job, NoGoal{}); }
  /// Null until the navigator has heard the last command.
  [[nodiscard]] std::shared_ptr<const NavigatorState> state(JobContext& job) const;

 private:
  void send(JobContext& job, std::variant<HoverAt, GoTo, NoGoal> what);

  GuidanceTopics topics_;
  std::uint64_t sent_{};
};

}  // namespace flyball
