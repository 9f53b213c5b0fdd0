// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Gets the vehicle to a goal through what the map knows: asks for plans, splices them into the
/// committed path, and keeps the latency that the speed limit follows from.

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
  /// The path comes straight from here, and bends at the start as fast as room allows.
  std::optional<Vec3> lead_in_W{};
  Vec3 goal_W{Vec3::Zero()};
  bool may_be_tight{};              ///< Only the slow tube is asked for.
  double iteration_s{};             ///< Of a search, as the last ones took; 0: not known.
  std::optional<KnownWay> known{};  ///< Was found before: nothing is sought, it begins elsewhere.
};

struct PlanAnswer {
  std::uint64_t id{};
  std::vector<Vec3> waypoints_W{};  ///< Empty: `failure` says why.
  Vec3 start_direction_W{Vec3::Zero()};
  std::optional<Vec3> lead_in_W{};
  Cylinder body{};  ///< For which it was found.
  std::string failure{};
  double iterations{};
};

struct PlannedPath {
  std::uint64_t id{};
  Trajectory trajectory{};
  std::string failure{};
  bool map_moved_on{};  ///< It failed on a newer map than it was planned on: plan again at once.
  KnownWay way{};       ///< That the trajectory follows.
  double iterations{};  ///< That it took to find it.
};

class Navigator {
 public:
  explicit Navigator(MissionContext& context);

  void hover_at(const Vec3& p_W, double yaw_rad);
  void set_goal(MissionTime now, const Vec3& goal_W);
  void clear_goal();
  /// Where it comes to stand, the camera turns to this heading.
  void face(std::optional<double> yaw_rad) { follower_.face(yaw_rad); }
  [[nodiscard]] bool has_arrived() const;

  /// A map was published: known-free space, latency bound, and whether the path is still good.
  void map_published(MissionTime now, const MapRevision& revision);
  void path_checked(MissionTime now, const PathCheck& check, std::uint64_t path_number);
  [[nodiscard]] std::uint64_t path_number() const { return path_number_; }
  /// A plan to ask for now, if any.
  [[nodiscard]] std::optional<PlanQuery> next_query(MissionTime now);
  void path_planned(MissionTime now, const PlannedPath& planned);

  /// Set-point for the flight controller; `revision` is the newest that the vehicle has.
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
  std::optional<double> blocked_at_m_{};  ///< On the path; none: it is not known to be.
  int refusals_{};  ///< Plans in a row that came too late or bent too sharply to be flown into.
  std::optional<KnownWay> known_{};  ///< The way of the last one of these.
  bool joins_{};                     ///< The pending plan is that way, from elsewhere.
  int stalls_{};  ///< Plans in a row that have led nowhere: they count as failed ones.
  StepBack back_{};
  MissionTime asked_at_{};
  PlanLead lead_{};
  double searched_s_{};  ///< The last search for a way took so long.
  bool wants_plan_{};
  bool is_searching_{};  ///< For the place where it is.
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
