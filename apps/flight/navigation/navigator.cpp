// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/navigator.h"

#include "flyball/flight/perception/counted_map.h"
#include "flyball/flight/perception/pose_history.h"

#include <utility>

namespace flyball {
namespace {

// Chosen by hand.
constexpr double rests_below_m_s = 0.02;  // The speed of PathFollower's standstill.
constexpr double moves_above_m_s = 0.2;   // Faster than the creeping before unknown space.

}  // namespace

Navigator::Navigator(std::shared_ptr<const Brief> brief, std::shared_ptr<PathTracker> path_tracker)
    : brief_{std::move(brief)},
      path_tracker_{std::move(path_tracker)},
      follower_{brief_},
      patience_{brief_->settings.mission.plan_time_limit_s},
      newest_{frame_price(*brief_)} {}

void Navigator::set_knobs(MissionTime now, std::shared_ptr<const KnobsInForce> knobs) {
  if (knobs == knobs_) {
    return;  // The same message: it is the newest one at most ticks.
  }
  knobs_ = std::move(knobs);
  follower_.set_knobs(knobs_);
  path_tracker_->apply(knobs_->knobs);
  if (newest_.note_terms(now, terms_of(*knobs_, *brief_))) {
    follower_.set_latency_bound(newest_.age_bound());
  }
}

void Navigator::obey(MissionTime now, const GuidanceCommand& command) {
  obeyed_ = command.number;
  if (const auto* hover = std::get_if<HoverAt>(&command.what)) {
    hover_at(hover->p_W, hover->yaw_rad);
  } else if (const auto* go = std::get_if<GoTo>(&command.what)) {
    goal_yaw_rad_ = go->yaw_rad;
    is_one_of_many_ = go->is_one_of_many;
    patience_.begin(now);
    failures_.begin_goal();
    if (!is_one_of_many_) {
      back_.begin_goal();
    }
    set_goal(now, go->p_W);
  } else {
    clear_goal();
  }
}

void Navigator::hover_at(const Vec3& p_W, double yaw_rad) {
  back_.forget();
  leave_path_at(p_W, yaw_rad);
}

void Navigator::leave_path_at(const Vec3& p_W, double yaw_rad) {
  follower_.hover_at(p_W, yaw_rad);
  overdue_.reset();  // It belongs to the path that is left.
  blocked_at_m_.reset();
  ++path_number_;
}

void Navigator::set_goal(MissionTime now, const Vec3& goal_W) {
  goal_W_ = last_goal_W_ = goal_W;
  asked_.reset();
  overdue_.reset();
  known_.reset();
  detours_.begin();
  stops_for_plan_ = false;
  knows_way_ = flown_.leads_to(goal_W);
  want_plan(now, "new goal");
}

void Navigator::clear_goal() {
  goal_W_.reset();
  wants_plan_ = false;
  asked_.reset();
  overdue_.reset();
}

bool Navigator::has_arrived() const {
  return goal_W_ && follower_.is_at_end() &&
         (follower_.position_W() - *goal_W_).norm() < brief_->settings.mission.goal_tolerance_m;
}

void Navigator::note_map(MissionTime now, const PathClearance& clearance) {
  (void)newest_.note_terms(now, terms_of(*knobs_, *brief_));
  newest_.note(clearance.revision, clearance.published);
  follower_.map_captured(newest_.captured(), newest_.revision().longest_range_m);
  follower_.set_latency_bound(newest_.age_bound());
}

void Navigator::refresh_known_free() {
  if (newest_.has_map()) {
    const CountedMap map{newest_.map()};
    follower_.refresh_known_free(map);
    map.add_to(news_.asked);
  }
}

void Navigator::path_checked(MissionTime now, const PathClearance& clearance) {
  note_map(now, clearance);
  if (clearance.path_number != path_number_) {  // Another path was checked than is flown now.
    refresh_known_free();
    return;
  }
  follower_.set_known_free(clearance.free_until_m);
  blocked_at_m_ = clearance.blocked_at_m;
  if (blocked_at_m_ && !asked_) {
    want_plan(now, "path blocked");
  }
  note_finer_map(now);
}

/// While the vehicle does not know where it is, no path is flown; afterwards, from where it then
/// is.
void Navigator::resume_after_search(MissionTime now, const PoseEstimate& where) {
  if (!search_) {
    return;
  }
  search_.reset();
  // Where nothing is mapped, the path is as free as before, and a new one would begin again with
  // what has been scanned.
  if (!brief_->maps_obstacles && follower_.has_path()) {
    follower_.pick_up_at(where.X_WB.translation());
    return;
  }
  hover_at(where.X_WB.translation(), yaw_of(where.X_WB.linear().col(0)));
  if (goal_W_) {
    patience_.resume(now);
    set_goal(now, *goal_W_);
  }
}

/// Where the fallback asks for a hover, the search goes no farther.
Setpoint Navigator::searched(MissionTime now, const Setpoint& search) {
  if (!search_ || !knobs_->restraint.must_hover) {
    search_ = search;
  }
  search_->stamp = now;
  return *search_;
}

/// A pose that is too old would draw the vehicle to where the path was then, and past its end: the
/// vehicle brakes, and is taken to be where it was told to be.
PoseEstimate Navigator::believed(MissionTime now, const PoseEstimate& where) {
  const bool was_blind = std::exchange(is_blind_, now - where.stamp > longest_pose_age);
  if (is_blind_ != was_blind) {
    news_.events.emplace_back(is_blind_ ? "no pose for too long: brakes" : "poses come again");
  }
  follower_.stop(is_blind_);
  PoseEstimate here = where;
  if (is_blind_) {
    here.X_WB.translation() = follower_.position_W();
  }
  return here;
}

void Navigator::note_rest(MissionTime now, double speed_m_s) {
  const bool rests = speed_m_s <= rests_below_m_s;
  at_rest_since_ = rests ? at_rest_since_.value_or(now) : std::optional<MissionTime>{};
  if (speed_m_s > moves_above_m_s) {
    failures_.moved();
  }
  std::optional<double> to_goal_m;
  if (goal_W_ && !has_arrived()) {
    to_goal_m = (*goal_W_ - follower_.position_W()).norm();
  }
  if (knobs_->restraint.must_hover) {
    patience_.resume(now);  // A vehicle that is told to stand may do so for as long as it is told.
  }
  news_.gives_up |= patience_.note(now, to_goal_m, rests);
  // What shuts the way may stand where each leg of it ends, and the vehicle would go there again
  // and again.
  knows_way_ = knows_way_ && !patience_.comes_no_nearer(now);
}

// The same view would fail again, or show the same detour. A step back turns by itself.
std::optional<Vec3> Navigator::way_to_look_for() const {
  const bool fails = failures_.count() > 0 && !follower_.has_path();
  const bool looks = fails || detours_.holds_back() || stops_for_plan_;
  return looks && !back_.is_active() ? goal_W_ : std::nullopt;
}

Setpoint Navigator::tick(MissionTime now,
                         Duration dt,
                         const PoseEstimate& where,
                         const std::optional<Setpoint>& search) {
  if (search) {
    return searched(now, *search);
  }
  const PoseEstimate here = believed(now, where);
  resume_after_search(now, here);
  const Vec3 error_W = follower_.position_W() - here.X_WB.translation();
  tracking_error_ = follower_.tracking_error(error_W);
  follower_.look_for_way_to(way_to_look_for());
  follower_.face(back_.is_active() ? std::nullopt : goal_yaw_rad_);
  const PathReference reference = follower_.tick(now, dt, error_W);
  if (back_.is_active() && !is_blind_ && !knobs_->restraint.must_hover) {
    go_back(now, dt, error_W.norm());
  } else if (follower_.has_path()) {
    back_.flew(follower_.position_W());
    if (brief_->maps_obstacles && !knows_way_) {
      flown_.flew(follower_.position_W());
    }
  }
  note_rest(now, reference.speed_m_s);
  if (const auto use = newest_.first_use(now)) {
    news_.map_use = use;
  }
  if (!follower_.has_path()) {
    Setpoint hover;
    hover.stamp = now;
    hover.p_WB = follower_.position_W();
    hover.yaw_rad = follower_.yaw_rad();
    return hover;
  }
  return path_tracker_->track(follower_.path(), reference, to_correct(here), now);
}

/// Nothing where the flight controller does it.
PoseEstimate Navigator::to_correct(const PoseEstimate& here) const {
  PoseEstimate there = here;
  if (brief_->leaves_errors_to_controller) {
    there.X_WB.translation() = follower_.position_W();
  }
  return there;
}

NavigatorState Navigator::state() const {
  NavigatorState state;
  state.obeyed = obeyed_;
  state.has_goal = goal_W_.has_value();
  state.goal_W = last_goal_W_;
  state.has_arrived = has_arrived();
  state.path_number = path_number_;
  state.path = follower_.shared_path();
  state.s_m = follower_.s_m();
  state.position_W = follower_.position_W();
  state.yaw_rad = follower_.yaw_rad();
  if (!search_) {  // What is flown during a search is none of the path's speeds.
    state.speed_m_s = follower_.speed_m_s();
    state.target_speed_m_s = follower_.target_speed_m_s();
  }
  state.stands_still = follower_.stands_still();
  state.must_hover = knobs_ && knobs_->restraint.must_hover;
  state.known_free_m = follower_.known_free_m();
  state.latency_bound = follower_.latency_bound();
  state.tracking_error = tracking_error_;
  state.planner_failures = failures_.count();
  state.replans = replans_;
  state.map_revision = newest_.revision().number;
  state.map_latency = newest_.latency();
  state.map_captured = newest_.captured();
  state.map_range_m = newest_.revision().range_m;
  state.map = newest_.published();
  return state;
}

}  // namespace flyball
