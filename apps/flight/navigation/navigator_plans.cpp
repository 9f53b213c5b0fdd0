// SPDX-License-Identifier: BSD-3-Clause
// tested-in: navigator
#include "flyball/flight/navigation/navigator.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// All of these are chosen by hand, for the reason that stands beside each.
constexpr auto retry_after = 500ms;   // The same map would fail again: wait for some frames.
constexpr auto finer_patience = 3s;   // How long to wait for a map of smaller cells.
constexpr int most_refusals = 3;      // A path that cannot be joined so often is given up.
constexpr double room_to_turn_m = 3;  // Left before an obstacle: the radius of a turn at 3 m/s.
constexpr double creeps_below_m_s = 0.05;  // The speed at which a corner is passed (SpeedProfile).
constexpr double turning_m_s2 = 3.0;       // To turn back, it brakes and speeds up again like this.
constexpr double long_detour_s = 10.0;     // Several times what a stop and a search cost.

/// What is left of the path, every metre and at its end.
std::vector<Vec3> rest_of(const PathFollower& follower) {
  const Path& path = follower.path();
  std::vector<Vec3> rest_W;
  for (double s_m = follower.s_m(); s_m < path.length_m(); s_m += 1.0) {
    rest_W.push_back(path.at(s_m).p_W);
  }
  rest_W.push_back(path.at(path.length_m()).p_W);
  return rest_W;
}

}  // namespace

void Navigator::want_plan(MissionTime now, const std::string& why) {
  if (!wants_plan_) {
    wants_plan_ = true;
    not_before_ = std::max(now, not_before_);
    news_.events.push_back("plan wanted: " + why);
  }
}

// In larger cells a door may have been closed, and the path is the way around. The way through the
// door is looked for once, when the first map of smaller cells is there.
void Navigator::note_finer_map(MissionTime now) {
  if (!asked_ && detours_.shows_more(newest_.map().resolution_m()) && is_detour()) {
    if (is_long_detour(rest_of(follower_))) {
      stops_for_plan_ = true;  // So that it does not come too late.
    }
    want_plan(now, "a finer map may show a shorter path");
  }
}

bool Navigator::is_long_detour(const std::vector<Vec3>& path_W) const {
  return situation().detour_s(path_W) > long_detour_s;
}

// Along such a path the camera turns away from the door before the smaller cells are there. So the
// vehicle does not turn into it, once for each size of cells that is asked for. The next search is
// made in a map of smaller cells, if one comes in time.
bool Navigator::needs_finer_map(const PlannedPath& planned) const {
  return brief_->maps_obstacles && detours_.may_await(knobs_->value("map.resolution_m")) &&
         is_long_detour(planned.path.waypoints_W);
}

void Navigator::wait_for_finer_map(MissionTime now, const PlannedPath& planned) {
  detours_.hold_back(planned.path, knobs_->value("map.resolution_m"));
  not_before_ = now;
  want_plan(now, "a finer map may show a shorter path");
}

/// To be joined without a search, from where the vehicle stops: there, no bend is too sharp.
void Navigator::take_held_back() {
  known_ = detours_.take();
  stops_for_plan_ = true;
}

/// No shorter path was found than the long detour that it has stopped on, which is still free.
bool Navigator::flies_detour_on() {
  if (!std::exchange(stops_for_plan_, false) || blocked_at_m_ || !is_detour() ||
      !is_long_detour(rest_of(follower_))) {
    return false;
  }
  follower_.commit_stop(follower_.path().length_m());
  return true;
}

bool Navigator::is_detour() const {
  if (!goal_W_ || !follower_.has_path()) {
    return false;
  }
  const double line_m = (*goal_W_ - follower_.position_W()).norm();
  return follower_.path().length_m() - follower_.s_m() > line_m + least_detour_m;
}

std::optional<PlanQuery> Navigator::next_query(MissionTime now) {
  constexpr auto lost_after = std::chrono::seconds{30};  // Three times a plan's deadline.
  if (asked_ && now - asked_->at > lost_after) {
    // Neither a path nor a failure has come: a message was lost, or the search takes so long.
    overdue_ = std::exchange(asked_, std::nullopt);
    want_plan(now, "no answer to a plan");
  }
  if (!goal_W_ || !newest_.has_map() || asked_ || back_.is_active()) {
    return std::nullopt;
  }
  if ((follower_.is_at_end() && !has_arrived()) || is_leg_ending()) {
    want_plan(now, "path ends short of the goal");
  }
  note_stall(now);
  if (!wants_plan_ || now < not_before_ || awaits_finer_map(now)) {
    return std::nullopt;
  }
  if (detours_.is_found_again(newest_.map().resolution_m())) {
    take_held_back();  // No map of smaller cells has come.
  }
  wants_plan_ = false;
  ++replans_;
  return query(now);
}

// A search that has failed in large cells would fail in them again and use up its whole budget, and
// one that found a long detour would find it again. When the governor has asked for smaller cells,
// the search waits for the first map of them.
bool Navigator::awaits_finer_map(MissionTime now) const {
  return !known_ && (failures_.count() > 0 || detours_.holds_back()) &&
         now < not_before_ + finer_patience &&
         are_smaller_cells(knobs_->value("map.resolution_m"), newest_.map().resolution_m());
}

PlanQuery Navigator::query(MissionTime now) {
  PlanQuery query;
  query.id = next_id_++;
  query.start_W = follower_.position_W();
  const double splice_m = follower_.has_path() ? start_from_path(query) : 0.0;
  asked_ = Asked{query.id, now, splice_m, known_.has_value()};
  if (!asked_->joins) {
    detours_.searched(newest_.map().resolution_m());
  }
  query.known = std::exchange(known_, std::nullopt);
  query.may_turn_back =
      stops_for_plan_ || lead_.lead_s() > 2.0 * follower_.speed_m_s() / turning_m_s2;
  query.goal_W = *goal_W_;
  query.failures = failures_.count();
  // When no path was found twice with the narrow tube, none will be found with a wide one.
  query.may_be_tight = situation().is_slow_at(query.start_W) || failures_.count() > 1;
  query.iteration_s = lead_.iteration_s();
  if (needs_flown_way(query)) {
    query.flown_W = flown_.between(query.start_W, query.goal_W, brief_->settings.planner.horizon_m);
  }
  return query;
}

// Where a search may take long or find nothing, the way that was flown takes its place. In a
// forest, a search finds a shorter one at once. Each third plan after failures is made without it,
// because the way may be what has failed.
bool Navigator::needs_flown_way(const PlanQuery& query) const {
  const bool may_search_long = failures_.count() > 0 || brief_->settings.planner.horizon_m > 0.0 ||
                               situation().is_slow_at(query.start_W);
  return knows_way_ && !query.known && may_search_long && failures_.count() % 3 != 2;
}

// The next plan is asked for so early that the vehicle need not stop, and so late that the next
// leg, which is half a horizon at least, is longer than what is left of this one. A shorter leg is
// the free part of the way that was flown. After it, the next plan is asked for near its end only,
// because there the cells are smaller and more of the way is free.
bool Navigator::is_leg_ending() const {
  const double horizon_m = brief_->settings.planner.horizon_m;
  if (horizon_m <= 0.0 || !follower_.has_path()) {
    return false;
  }
  const Path& path = follower_.path();
  const bool is_short = path.length_m() < 0.5 * horizon_m;
  const double left_m = knows_way_ && is_short ? room_to_turn_m : 0.4 * horizon_m;
  return path.length_m() - follower_.s_m() < left_m &&
         (path.at(path.length_m()).p_W - *goal_W_).norm() >
             brief_->settings.mission.goal_tolerance_m;
}

// The vehicle flies on through known-free space while a plan is made, because the map shows more
// from nearer by, and because most plans are ready before the vehicle must stop.
double Navigator::last_stop_m() const {
  const double blocked_m = blocked_at_m_.value_or(follower_.path().length_m() + room_to_turn_m);
  return std::max(follower_.planned_stop_m(),
                  std::min(blocked_m - room_to_turn_m, follower_.farthest_stop_m()));
}

// The first attempt lets the new path leave the old one ahead of the moving vehicle. If that path
// bends too sharply for the vehicle's speed, or comes too late, the next attempts leave from the
// place where the vehicle will soon come to rest, as a path does that the vehicle is to stop for.
// So do those of a vehicle that stands already: it creeps forward with each cell that becomes
// known, and would have passed a splice at its present place before the plan is ready.
double Navigator::start_from_path(PlanQuery& query) {
  const Path& path = follower_.path();
  const double lead_s = known_ ? least_plan_lead_s : lead_.lead_s();
  const bool leaves_moving =
      failures_.refusals() == 0 && !stops_for_plan_ && follower_.speed_m_s() >= creeps_below_m_s;
  const double stop_m = leaves_moving ? last_stop_m() : follower_.planned_stop_m();
  const double moving_m = std::min(follower_.s_m() + follower_.speed_m_s() * lead_s, stop_m);
  follower_.commit_stop(stop_m);
  const double splice_m = leaves_moving ? moving_m : stop_m;
  query.start_W = path.at(splice_m).p_W;
  query.start_direction_W =
      follower_.speed_m_s() > 0.2 ? path.at(splice_m).tangent_W : Vec3::Zero();
  return splice_m;
}

void Navigator::plan_failed(MissionTime now, const Asked& asked, const PlannedPath& planned) {
  if (asked.joins) {  // A known path could not be joined; no search has failed, so one is made now.
    want_plan(now, "the path cannot be joined: " + planned.failure);
    return;
  }
  if (detours_.holds_back() && !planned.map_moved_on) {
    take_held_back();
    want_plan(now, "no shorter path: " + planned.failure);
    return;
  }
  if (!planned.map_moved_on && flies_detour_on()) {
    return;
  }
  if (!planned.map_moved_on) {
    failures_.search_failed();
  }
  if (planned.failure == "start blocked" && at_rest_since_) {
    leave_blocked_place();
  } else if (at_rest_since_ && !planned.map_moved_on) {
    look_from_elsewhere();
  }
  // The governor sees the failure first, because its settings may be the reason.
  const Duration look = from_seconds(brief_->settings.governor.period_s);
  not_before_ = now + (planned.map_moved_on ? look : std::max<Duration>(look, retry_after));
  want_plan(now, planned.failure);
}

// A path that was found late is mostly a detour. It is worth flying where its additional metres
// take no more time than another search would; in rooms, where flight is slow, they take more.
bool Navigator::is_worth_joining(const std::vector<Vec3>& path_W) const {
  const double limit_m_s = situation().speed_limit_m_s(follower_.position_W());
  const double search_s = std::max(lead_.lead_s(), lead_.last_s());
  return path_W.size() >= 2 && detour_m(path_W) <= search_s * limit_m_s;
}

// A path that took seconds to find is not thrown away because the vehicle has passed its start or
// is too fast for its first bend. Instead the vehicle joins it from another place. The first such
// place is a point ahead again, since that takes no search.
void Navigator::plan_refused(MissionTime now, const Asked& asked, const PlannedPath& planned) {
  const bool is_late = follower_.s_m() > asked.splice_m;
  const bool is_first_late = is_late && !asked.joins && failures_.refusals() == 0;
  if (!is_first_late) {
    failures_.path_refused();
  }
  if (failures_.refusals() < most_refusals && is_worth_joining(planned.path.waypoints_W)) {
    known_ = planned.path;
  }
  want_plan(now, is_late ? "too late for the plan" : "too fast for the plan");
}

void Navigator::path_planned(MissionTime now, const PlannedPath& planned) {
  if (overdue_ && planned.id == overdue_->id) {
    asked_ = std::exchange(overdue_, std::nullopt);  // What was asked after it is not awaited.
  }
  if (!asked_ || planned.id != asked_->id) {
    return;
  }
  const Asked asked = *std::exchange(asked_, std::nullopt);
  if (!asked.joins) {
    lead_.took(to_seconds(now - asked.at), planned.iterations);
  }
  if (!planned.failure.empty()) {
    plan_failed(now, asked, planned);
    return;
  }
  if (!asked.joins && needs_finer_map(planned)) {
    wait_for_finer_map(now, planned);
    return;
  }
  failures_.path_found();
  detours_.drop();
  const Path path{planned.trajectory};
  if (!follower_.adopt(path, asked.splice_m)) {
    plan_refused(now, asked, planned);
    return;
  }
  failures_.path_joined();
  overdue_.reset();  // A plan that was asked for before this one begins on the path before it.
  stops_for_plan_ = false;
  blocked_at_m_.reset();
  ++path_number_;
  refresh_known_free();
}

}  // namespace flyball
