// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/navigator.h"

#include "flyball/flight/navigation/step_aside.h"
#include "flyball/flight/navigation/sub_goal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto retry_after = 500ms;     // The same map would fail again: wait for frames.
constexpr auto finer_patience = 3s;     // For a map of smaller cells that is on its way.
constexpr int most_refusals = 3;        // Of one way: then another one is looked for.
constexpr double room_to_turn_m = 3.0;  // Left before what blocks the path.
constexpr double arrival_m = 0.3;
constexpr double rests_below_m_s = 0.02;
constexpr double moves_above_m_s = 0.2;
constexpr double creeps_below_m_s = 0.05;
constexpr double least_lead_in_m = 0.3;
constexpr double straight = 0.999;  // Chord over arc.
constexpr double rounding_m = 1e-6;

}  // namespace

Navigator::Navigator(MissionContext& context)
    : context_{context}, follower_{context}, map_latency_{frame_price(context)} {}

void Navigator::hover_at(const Vec3& p_W, double yaw_rad) {
  follower_.hover_at(p_W, yaw_rad);
  back_.forget();
  blocked_at_m_.reset();
  ++path_number_;
}

void Navigator::set_goal(MissionTime now, const Vec3& goal_W) {
  goal_W_ = goal_W;
  context_.goal_now_W = goal_W;
  without_path_since_ = now;
  pending_id_ = 0;
  known_.reset();
  want_plan(now, "new goal");
}

void Navigator::clear_goal() {
  goal_W_.reset();
  wants_plan_ = false;
  pending_id_ = 0;
}

bool Navigator::has_arrived() const {
  return goal_W_ && follower_.is_at_end() && (follower_.position_W() - *goal_W_).norm() < arrival_m;
}

void Navigator::map_published(MissionTime now, const MapRevision& revision) {
  (void)map_latency_.note_terms(now, terms_of(context_));
  map_latency_.published(revision, now);
  newest_latency_ = now - revision.captured;
  map_revision_ = revision.number;
  if (map_latency_.budget_use() > 1.0) {
    ++context_.counters.bound_overruns;
  }
  context_.counters.budget_use.push_back(map_latency_.budget_use());
  unused_capture_ = newest_capture_ = revision.captured;
  follower_.map_published(revision);
  follower_.set_latency_bound(map_latency_.latency_bound() + map_latency_.interval_bound());
  follower_.refresh_known_free(context_.map());
}

void Navigator::path_checked(MissionTime now, const PathCheck& check, std::uint64_t path_number) {
  if (path_number != path_number_) {
    return;
  }
  blocked_at_m_ = check.blocked_at_m;
  if (blocked_at_m_ && pending_id_ == 0) {
    want_plan(now, "path blocked");
  }
}

void Navigator::want_plan(MissionTime now, const std::string& why) {
  if (!wants_plan_) {
    wants_plan_ = true;
    not_before_ = std::max(now, not_before_);
    context_.event(now, "plan wanted: " + why);
  }
}

std::optional<PlanQuery> Navigator::next_query(MissionTime now) {
  if (!goal_W_ || pending_id_ != 0 || back_.is_active()) {
    return std::nullopt;
  }
  if ((follower_.is_at_end() && !has_arrived()) || is_leg_ending()) {
    want_plan(now, "path ends short of the goal");
  }
  note_stall(now);
  if (!wants_plan_ || now < not_before_ || awaits_finer_map(now)) {
    return std::nullopt;
  }
  asked_at_ = now;
  wants_plan_ = false;
  ++context_.counters.replans;
  return query();
}

// What has failed in large cells fails in them again, and takes its whole budget: where smaller
// ones are on their way, the search waits for their first frame.
bool Navigator::awaits_finer_map(MissionTime now) const {
  return context_.counters.planner_failures_in_row > 0 && now < not_before_ + finer_patience &&
         context_.knobs.value("map.resolution_m") < context_.map().resolution_m() - rounding_m;
}

PlanQuery Navigator::query() {
  PlanQuery query;
  query.id = pending_id_ = next_id_++;
  query.start_W = follower_.position_W();
  if (follower_.has_path()) {
    start_from_path(query);
  }
  joins_ = known_.has_value();
  query.known = std::exchange(known_, std::nullopt);
  query.goal_W =
      sub_goal_W(context_, query.start_W, *goal_W_, context_.counters.planner_failures_in_row);
  // Where the narrow tube has found no way twice, a wide one will not.
  query.may_be_tight = context_.speed_limit_m_s(query.start_W) <= 1.0 ||
                       context_.counters.planner_failures_in_row > 1;
  query.iteration_s = lead_.iteration_s();
  return query;
}

// Early enough that the vehicle flies on, late enough that the next leg, half a horizon at least,
// is longer than what is left.
bool Navigator::is_leg_ending() const {
  const double horizon_m = context_.settings.planner.horizon_m;
  if (horizon_m <= 0.0 || !follower_.has_path()) {
    return false;
  }
  const Path& path = follower_.path();
  return path.length_m() - follower_.s_m() < 0.4 * horizon_m &&
         (path.at(path.length_m()).p_W - *goal_W_).norm() > arrival_m;
}

// What is known to be free is flown on while a plan is made: from nearer by the map shows more, and
// most plans are there before the vehicle must stop.
double Navigator::last_stop_m() const {
  const double blocked_m = blocked_at_m_.value_or(follower_.path().length_m() + room_to_turn_m);
  return std::max(follower_.planned_stop_m(),
                  std::min(blocked_m - room_to_turn_m, follower_.farthest_stop_m()));
}

// At first the new path leaves the old one ahead of the moving vehicle. If it then bends too
// sharply for the vehicle's speed, or comes too late, the next one leaves where the vehicle would
// soon come to rest, so that the bend can begin before that; at last it starts from rest. So does
// the plan of a vehicle that stands already: it creeps on with each cell that becomes known, and
// would have left a splice where it stands before the plan is there.
void Navigator::start_from_path(PlanQuery& query) {
  const Path& path = follower_.path();
  const double lead_s = known_ ? least_plan_lead_s : lead_.lead_s();
  const bool leaves_moving = refusals_ == 0 && follower_.speed_m_s() >= creeps_below_m_s;
  const double stop_m = leaves_moving ? last_stop_m() : follower_.planned_stop_m();
  const double moving_m = std::min(follower_.s_m() + follower_.speed_m_s() * lead_s, stop_m);
  const Vec3 moving_W = path.at(moving_m).p_W;
  const Vec3 stop_W = path.at(stop_m).p_W;
  const double chord_m = (stop_W - moving_W).norm();
  if (refusals_ == 1 && chord_m > std::max(least_lead_in_m, straight * (stop_m - moving_m))) {
    query.lead_in_W = moving_W;
  }
  follower_.commit_stop(stop_m);
  splice_m_ = leaves_moving || query.lead_in_W ? moving_m : stop_m;
  query.start_W = leaves_moving ? moving_W : stop_W;
  query.start_direction_W =
      follower_.speed_m_s() > 0.2 ? path.at(splice_m_).tangent_W : Vec3::Zero();
}

void Navigator::plan_failed(MissionTime now, const PlannedPath& planned) {
  if (joins_) {  // No plan has failed: one is made from here now.
    want_plan(now, "the way does not join: " + planned.failure);
    return;
  }
  ++context_.counters.planner_failures_in_row;
  if (planned.failure == "start blocked" && at_rest_since_) {
    if (const auto aside_W = place_aside_W(context_, follower_.position_W())) {
      hover_at(*aside_W, follower_.yaw_rad());
    }
    trust_own_place();
  }
  // The governor looks at a failure first: its settings may be why.
  const Duration look = from_seconds(context_.settings.governor.period_s);
  not_before_ = now + (planned.map_moved_on ? look : std::max<Duration>(look, retry_after));
  want_plan(now, planned.failure);
}

// What was found late is mostly a way around. It is worth its search where the metres more cost no
// more time than another search might; in rooms they do.
bool Navigator::is_worth_joining(const std::vector<Vec3>& way_W) const {
  const double limit_m_s = context_.speed_limit_m_s(follower_.position_W());
  const double search_s = std::max(lead_.lead_s(), searched_s_);
  return way_W.size() >= 2 && detour_m(way_W) <= search_s * limit_m_s;
}

// A way that was found after seconds of search is not lost because the vehicle has flown on, or is
// too fast for its first bend: it is flown into from elsewhere. At first from a point ahead again,
// since that takes no search.
void Navigator::plan_refused(MissionTime now, const PlannedPath& planned) {
  const bool is_late = follower_.s_m() > splice_m_;
  refusals_ += is_late && !joins_ && refusals_ == 0 ? 0 : 1;
  if (refusals_ < most_refusals && is_worth_joining(planned.way.waypoints_W)) {
    known_ = planned.way;
  }
  want_plan(now, is_late ? "too late for the plan" : "too fast for the plan");
}

void Navigator::path_planned(MissionTime now, const PlannedPath& planned) {
  if (planned.id != pending_id_) {
    return;
  }
  pending_id_ = 0;
  if (!joins_) {
    searched_s_ = to_seconds(now - asked_at_);
    lead_.took(searched_s_, planned.iterations);
  }
  if (!planned.failure.empty()) {
    plan_failed(now, planned);
    return;
  }
  context_.counters.planner_failures_in_row = stalls_;
  const Path path{planned.trajectory};
  if (!follower_.adopt(path, splice_m_)) {
    plan_refused(now, planned);
    return;
  }
  refusals_ = 0;
  blocked_at_m_.reset();
  ++path_number_;
  follower_.refresh_known_free(context_.map());
}

/// While the vehicle does not know where it is, no path is flown; afterwards, from where it then
/// is.
std::optional<Setpoint> Navigator::search_place(MissionTime now, const PoseEstimate& where) {
  const bool cruises = context_.phase == MissionPhase::cruise;
  if (cruises && context_.localization.is_lost()) {
    is_searching_ = true;
    return context_.localization.search(now, where.X_WB.translation().z());
  }
  if (is_searching_ && goal_W_) {
    hover_at(where.X_WB.translation(), yaw_of(where.X_WB.linear().col(0)));
    set_goal(now, *goal_W_);
  }
  is_searching_ = false;
  return std::nullopt;
}

Setpoint Navigator::tick(MissionTime now, Duration dt, const PoseEstimate& where) {
  if (const auto search = search_place(now, where)) {
    return *search;
  }
  if (map_latency_.note_terms(now, terms_of(context_))) {
    follower_.set_latency_bound(map_latency_.latency_bound() + map_latency_.interval_bound());
  }
  const Vec3 error_W = follower_.position_W() - where.X_WB.translation();
  tracking_error_ = follower_.tracking_error(error_W);
  const PathReference reference = follower_.tick(now, dt, error_W);
  if (back_.is_active()) {
    go_back(now, dt, error_W.norm());
  } else if (follower_.has_path()) {
    back_.flew(follower_.position_W());
  }
  const bool rests = reference.speed_m_s <= rests_below_m_s;
  at_rest_since_ = rests ? at_rest_since_.value_or(now) : std::optional<MissionTime>{};
  if (stalls_ > 0 && reference.speed_m_s > moves_above_m_s) {
    context_.counters.planner_failures_in_row = stalls_ = 0;
  }
  if (!rests || !goal_W_ || has_arrived()) {
    without_path_since_ = now;
  } else if (to_seconds(now - without_path_since_) > context_.settings.mission.plan_time_limit_s) {
    context_.finish(now, MissionStatus::failed, MissionFailure::no_plan);
  }
  if (unused_capture_) {
    context_.counters.latency_s.push_back(to_seconds(now - *unused_capture_));
    unused_capture_.reset();
  }
  if (!follower_.has_path()) {
    Setpoint hover;
    hover.stamp = now;
    hover.p_WB = follower_.position_W();
    hover.yaw_rad = follower_.yaw_rad();
    return hover;
  }
  return context_.kernels.path_tracker->track(follower_.path(), reference, where, now);
}

}  // namespace flyball
