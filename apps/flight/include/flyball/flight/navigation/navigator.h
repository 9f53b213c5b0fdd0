// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Flies the vehicle to a goal through the known map: requests plans, splices them into the
/// committed path, and keeps the bound on latency from which the speed limit follows.

#include "flyball/flight/navigation/known_way.h"
#include "flyball/flight/navigation/map_latency.h"
#include "flyball/flight/navigation/path_follower.h"
#include "flyball/flight/navigation/plan_lead.h"
#include "flyball/flight/navigation/step_back.h"

#include <string>

namespace flyball {

struct PlanQuery {
  std::uint64_t id{};
  Vec3 start_W{Vec3::Zero()};
  Vec3 start_direction_W{Vec3::Zero()};  ///< Zero: from a standstill.
  /// The trajectory begins here instead, leads straight to `start_W`, and turns there as sharply as
  /// the room allows.
  std::optional<Vec3> lead_in_W{};
  Vec3 goal_W{Vec3::Zero()};
  bool may_be_tight{};   ///< Only the tube of slow flight has to fit.
  double iteration_s{};  ///< Time of one iteration in the last searches; 0: not known.
  /// A path that was found before and is to be joined from `start_W`: nothing is searched for.
  std::optional<KnownWay> known{};
};

struct PlanAnswer {
  std::uint64_t id{};
  std::vector<Vec3> waypoints_W{};  ///< Empty: `failure` says why.
  Vec3 start_direction_W{Vec3::Zero()};
  std::optional<Vec3> lead_in_W{};
  Cylinder body{};  ///< The body, with its tube, that the path was planned for.
  std::string failure{};
  double iterations{};
};

struct PlannedPath {
  std::uint64_t id{};
  Trajectory trajectory{};
  std::string failure{};
  bool map_moved_on{};  ///< It failed on a newer map than it was planned on: plan again at once.
  KnownWay way{};       ///< The path that the trajectory follows.
  double iterations{};  ///< Iterations that the search took.
};

class Navigator {
 public:
  explicit Navigator(MissionContext& context);

  void hover_at(const Vec3& p_W, double yaw_rad);
  void set_goal(MissionTime now, const Vec3& goal_W);
  void clear_goal();
  /// At the place where the vehicle stops, the camera turns to this heading.
  void face(std::optional<double> yaw_rad) { follower_.face(yaw_rad); }
  [[nodiscard]] bool has_arrived() const;

  /// A map was published: updates the known-free distance and the latency bound, and whether the
  /// path is still free.
  void map_published(MissionTime now, const MapRevision& revision);
  void path_checked(MissionTime now, const PathCheck& check, std::uint64_t path_number);
  [[nodiscard]] std::uint64_t path_number() const { return path_number_; }
  /// The plan to request now, if any.
  [[nodiscard]] std::optional<PlanQuery> next_query(MissionTime now);
  void path_planned(MissionTime now, const PlannedPath& planned);

  /// Set-point for the flight controller.
  [[nodiscard]] Setpoint tick(MissionTime now, Duration dt, const PoseEstimate& where);
  [[nodiscard]] const PathFollower& follower() const { return follower_; }
  [[nodiscard]] Duration newest_latency() const { return newest_latency_; }
  [[nodiscard]] MissionTime newest_capture() const { return newest_capture_; }
  [[nodiscard]] std::uint64_t map_revision() const { return map_revision_; }
  [[nodiscard]] const TrackingError& tracking_error() const { return tracking_error_; }

 private:
  [[nodiscard]] bool is_leg_ending() const;
  [[nodiscard]] std::optional<Setpoint> search_place(MissionTime now, const PoseEstimate& where);
  void trust_own_place();
  void note_stall(MissionTime now);
  [[nodiscard]] bool steps_back(MissionTime now);
  void go_back(MissionTime now, Duration dt, double error_m);
  void plan_failed(MissionTime now, const PlannedPath& planned);
  [[nodiscard]] bool is_worth_joining(const std::vector<Vec3>& way_W) const;
  void plan_refused(MissionTime now, const PlannedPath& planned);
  [[nodiscard]] bool awaits_finer_map(MissionTime now) const;
  [[nodiscard]] PlanQuery query();
  [[nodiscard]] double last_stop_m() const;
  void start_from_path(PlanQuery& query);
  void want_plan(MissionTime now, const std::string& why);

  MissionContext& context_;
  PathFollower follower_;
  std::optional<Vec3> goal_W_{};
  std::uint64_t next_id_{1};
  std::uint64_t pending_id_{};  ///< 0: none.
  double splice_m_{};
  std::optional<double> blocked_at_m_{};  ///< Arc length; none: the path is not known blocked.
  int refusals_{};  ///< Plans in a row that came too late or bent too sharply to be joined.
  std::optional<KnownWay> known_{};  ///< The path of the last of these plans.
  bool joins_{};                     ///< The pending plan is that path, joined from elsewhere.
  int stalls_{};  ///< Plans in a row that led nowhere: they count as failed ones.
  StepBack back_{};
  MissionTime asked_at_{};
  PlanLead lead_{};
  double searched_s_{};  ///< How long the last search for a path took.
  bool wants_plan_{};
  bool is_searching_{};  ///< The localizer is lost, and the vehicle looks for a known place.
  MissionTime not_before_{};
  MissionTime without_path_since_{};
  std::uint64_t path_number_{};
  std::optional<MissionTime> at_rest_since_{};
  MapLatency map_latency_;
  Duration newest_latency_{};
  std::uint64_t map_revision_{};
  MissionTime newest_capture_{};
  std::optional<MissionTime> unused_capture_{};  ///< Of a revision that no command has used yet.
  TrackingError tracking_error_{};
};

}  // namespace flyball
