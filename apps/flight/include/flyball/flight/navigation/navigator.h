// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Flies the vehicle to a goal through the known map: requests plans, splices them into the
/// committed path, and keeps the bound on latency from which the speed limit follows.

#include "flyball/flight/navigation/detour_watch.h"
#include "flyball/flight/navigation/flown_way.h"
#include "flyball/flight/navigation/goal_patience.h"
#include "flyball/flight/navigation/guidance.h"
#include "flyball/flight/navigation/newest_map.h"
#include "flyball/flight/navigation/path_clearance.h"
#include "flyball/flight/navigation/path_follower.h"
#include "flyball/flight/navigation/plan_failures.h"
#include "flyball/flight/navigation/plan_lead.h"
#include "flyball/flight/navigation/plan_service.h"
#include "flyball/flight/navigation/situation.h"
#include "flyball/flight/navigation/step_back.h"
#include "flyball/flight/perception/map_hints.h"
#include "flyball/kernels/path_tracker.h"
#include "flyball/runtime/work.h"

#include <memory>
#include <string>
#include <vector>

namespace flyball {

/// What the navigator has to say beside its set-point and its query.
struct NavigatorNews {
  std::vector<std::string> events{};
  std::vector<MapHint> map_hints{};
  std::optional<MapUse> map_use{};
  Work asked{};     ///< Of the map: see `CountedMap`.
  bool gives_up{};  ///< It has stood without a path, or come no nearer, for too long.
};

/// One node owns it; all that it knows comes by messages, and all that it says goes by messages.
class Navigator {
 public:
  Navigator(std::shared_ptr<const Brief> brief, std::shared_ptr<PathTracker> path_tracker);

  /// The knobs in force from now on; to be called before anything else.
  void set_knobs(MissionTime now, std::shared_ptr<const KnobsInForce> knobs);
  /// Where nothing maps obstacles: the space that is declared free.
  void set_declared_map(std::shared_ptr<const OccupancyView> map) {
    newest_.declare(std::move(map));
  }
  void obey(MissionTime now, const GuidanceCommand& command);
  /// A map has been published, and the path was held against it.
  void path_checked(MissionTime now, const PathClearance& clearance);
  void path_planned(MissionTime now, const PlannedPath& planned);
  /// The plan to request now, if any.
  [[nodiscard]] std::optional<PlanQuery> next_query(MissionTime now);
  /// Set-point for the flight controller.
  /// @param search  While the localizer is lost: what it asks for instead.
  [[nodiscard]] Setpoint tick(MissionTime now,
                              Duration dt,
                              const PoseEstimate& where,
                              const std::optional<Setpoint>& search = {});
  [[nodiscard]] NavigatorState state() const;
  /// What has come up since the last call.
  [[nodiscard]] NavigatorNews news() { return std::exchange(news_, {}); }

  [[nodiscard]] const PathFollower& follower() const { return follower_; }
  [[nodiscard]] bool has_arrived() const;

 private:
  /// A plan that has been asked for.
  struct Asked {
    std::uint64_t id{};
    MissionTime at{};
    double splice_m{};  ///< Where its path leaves the one that is flown; arc length of that one.
    bool joins{};       ///< A known path is joined from elsewhere; nothing is searched for.
  };
  void hover_at(const Vec3& p_W, double yaw_rad);
  void set_goal(MissionTime now, const Vec3& goal_W);
  void clear_goal();
  void refresh_known_free();
  void note_map(MissionTime now, const PathClearance& clearance);
  void note_finer_map(MissionTime now);
  [[nodiscard]] bool is_detour() const;
  [[nodiscard]] bool is_long_detour(const std::vector<Vec3>& path_W) const;
  [[nodiscard]] bool needs_finer_map(const PlannedPath& planned) const;
  void wait_for_finer_map(MissionTime now, const PlannedPath& planned);
  void take_held_back();
  [[nodiscard]] bool flies_detour_on();
  [[nodiscard]] std::optional<Vec3> way_to_look_for() const;
  void note_rest(MissionTime now, double speed_m_s);
  [[nodiscard]] Situation situation() const { return {*brief_, *knobs_, newest_.map()}; }
  [[nodiscard]] bool is_leg_ending() const;
  [[nodiscard]] Setpoint searched(MissionTime now, const Setpoint& search);
  void resume_after_search(MissionTime now, const PoseEstimate& where);
  [[nodiscard]] PoseEstimate believed(MissionTime now, const PoseEstimate& where);
  [[nodiscard]] PoseEstimate to_correct(const PoseEstimate& here) const;
  void trust_own_place();
  void note_stall(MissionTime now);
  void leave_blocked_place();
  void leave_path_at(const Vec3& p_W, double yaw_rad);
  [[nodiscard]] double yaw_ahead_rad() const;
  [[nodiscard]] bool steps_back(double away_m, double yaw_rad);
  [[nodiscard]] double blind_ahead_m() const;
  [[nodiscard]] bool sees_no_more() const;
  [[nodiscard]] bool leaves_blind_zone();
  void look_from_elsewhere();
  void go_back(MissionTime now, Duration dt, double error_m);
  void plan_failed(MissionTime now, const Asked& asked, const PlannedPath& planned);
  [[nodiscard]] bool is_worth_joining(const std::vector<Vec3>& path_W) const;
  void plan_refused(MissionTime now, const Asked& asked, const PlannedPath& planned);
  [[nodiscard]] bool awaits_finer_map(MissionTime now) const;
  [[nodiscard]] PlanQuery query(MissionTime now);
  [[nodiscard]] bool needs_flown_way(const PlanQuery& query) const;
  [[nodiscard]] double last_stop_m() const;
  /// @return  Where the plan is to leave the path: see `Asked`.
  [[nodiscard]] double start_from_path(PlanQuery& query);
  void want_plan(MissionTime now, const std::string& why);

  std::shared_ptr<const Brief> brief_;           ///< Owners: all nodes.
  std::shared_ptr<PathTracker> path_tracker_;    ///< See MissionKernels.
  std::shared_ptr<const KnobsInForce> knobs_{};  ///< Owners: whoever reads this snapshot.
  PathFollower follower_;
  NavigatorNews news_{};
  std::uint64_t obeyed_{};
  std::optional<Vec3> goal_W_{};
  std::optional<double> goal_yaw_rad_{};
  bool is_one_of_many_{};  ///< The goal: see GoTo.
  GoalPatience patience_;
  Vec3 last_goal_W_{Vec3::Zero()};
  std::uint64_t next_id_{1};
  std::optional<Asked> asked_{};
  std::optional<Asked> overdue_{};        ///< Asked for before that, and not answered for long.
  std::optional<double> blocked_at_m_{};  ///< Arc length; none: the path is not known blocked.
  std::optional<KnownPath> known_{};      ///< A path that was refused, or one held back before.
  PlanFailures failures_{};
  int replans_{};
  StepBack back_{};
  FlownWay flown_{};
  bool knows_way_{};  ///< The way that was flown leads to the goal.
  DetourWatch detours_{};
  bool stops_for_plan_{};  ///< The next path begins where the vehicle comes to rest.
  PlanLead lead_{};
  bool wants_plan_{};
  std::optional<Setpoint> search_{};  ///< While the localizer is lost: the last set-point of the
                                      ///< search for a known place.
  bool is_blind_{};                   ///< No pose has come for too long.
  MissionTime not_before_{};
  std::uint64_t path_number_{};
  std::optional<MissionTime> at_rest_since_{};
  NewestMap newest_;
  TrackingError tracking_error_{};
};

}  // namespace flyball
