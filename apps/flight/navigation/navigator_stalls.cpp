// SPDX-License-Identifier: BSD-3-Clause
// tested-in: navigator
#include "flyball/flight/navigation/navigator.h"
#include "flyball/flight/navigation/step_aside.h"

#include <algorithm>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// Chosen: by then the vehicle has looked left and right (PathFollower), and it has not helped.
constexpr auto stall_patience = 6s;
constexpr auto some_maps = 500ms;    // Chosen: ten frames of what lies ahead.
constexpr int tries = 3;             // Chosen: two may have failed because of noise in the map.
constexpr double elsewhere_m = 4.0;  // Chosen: there half of a fine map of 8 m is new.
constexpr double settled_m = 0.15;   // Chosen: from its reference, when it has stepped back.
constexpr double doubted_m = 12.0;   // Chosen: a fine map sees 8 m from 4 m farther back.

}  // namespace

// The vehicle stands here, so the place is free, although noise or the edge of an obstacle may have
// filled a cell that the body or its tube overlaps.
void Navigator::trust_own_place() {
  news_.map_hints.push_back(ClearSpace{follower_.position_W(), brief_->narrow_body()});
}

double Navigator::blind_ahead_m() const {
  const Intrinsics camera = brief_->settings.camera.intrinsics();
  return blind_m(newest_.map().resolution_m(), brief_->narrow_body(),
                 0.5 * camera.height_px / camera.focal_px);
}

// What is unknown lies too near, below or above the camera's field, so that looking to both sides
// would not show it.
bool Navigator::sees_no_more() const {
  const auto faces_path_since = follower_.faces_path_since();
  return faces_path_since && newest_.captured() >= *faces_path_since + some_maps &&
         follower_.known_free_m() < blind_ahead_m();
}

// The camera cannot see the space ahead from here, so the vehicle steps back. Where it cannot, it
// looks to both sides, and then a plan from here may lead elsewhere.
void Navigator::note_stall(MissionTime now) {
  const bool has_looked_aside = follower_.stalled(now) > stall_patience;
  if (wants_plan_ || !(has_looked_aside || sees_no_more())) {
    return;
  }
  const bool leaves = leaves_blind_zone();
  if (!leaves && !has_looked_aside) {
    return;
  }
  trust_own_place();
  failures_.stalled();
  if (!leaves) {
    want_plan(now, "stalled before unknown space");
  }
}

// Where no step aside is enough, the way by which the vehicle came is free.
void Navigator::leave_blocked_place() {
  const Vec3 here_W = follower_.position_W();
  const auto aside_W = place_aside_W(situation(), here_W);
  if (!aside_W) {
    (void)leaves_blind_zone();
  } else if (*aside_W != here_W) {
    leave_path_at(*aside_W, follower_.yaw_rad());
  }
  trust_own_place();
}

// The camera is to see what the vehicle stands before. Towards a place farther ahead, around the
// next corner, it would look past that.
double Navigator::yaw_ahead_rad() const {
  constexpr double ahead_m = 1.0;  // Chosen: a little beyond the zone that the camera is blind in.
  if (!follower_.has_path()) {
    return follower_.yaw_rad();
  }
  const Vec3 ahead_W = follower_.path().at(follower_.s_m() + ahead_m).p_W;
  return yaw_of(ahead_W - follower_.position_W());
}

bool Navigator::steps_back(double away_m, double yaw_rad) {
  const bool may_go = brief_->maps_obstacles && !knobs_->restraint.must_hover;
  if (!may_go || !back_.begin(away_m, yaw_rad)) {
    return false;
  }
  leave_path_at(follower_.position_W(), follower_.yaw_rad());
  return true;
}

bool Navigator::leaves_blind_zone() {
  if (!steps_back(blind_ahead_m(), yaw_ahead_rad())) {
    return false;
  }
  news_.events.push_back("steps back to see what is before it");
  return true;
}

// A path may have led past the only opening, which noise had closed, to where that is out of view.
// What closed it may be noise of looks from far away, in cells that no ray has crossed since then,
// so the map forgets its obstacles there. Where the mission has other goals, another one is reached
// sooner.
void Navigator::look_from_elsewhere() {
  const Vec3 here_W = follower_.position_W();
  if (failures_.count() < tries || is_one_of_many_ ||
      !steps_back(elsewhere_m, yaw_of(*goal_W_ - here_W))) {
    return;
  }
  news_.events.push_back("goes back to look for a path from there");
  if (patience_.may_doubt(here_W)) {
    news_.map_hints.push_back(DoubtedPlace{here_W, doubted_m});
  }
}

void Navigator::go_back(MissionTime now, Duration dt, double error_m) {
  const bool is_at_it = error_m < std::max(settled_m, brief_->arrival_error_m());
  const StepBack::Hover next =
      back_.tick(now, dt, {follower_.position_W(), follower_.yaw_rad()}, is_at_it);
  follower_.hover_at(next.p_W, next.yaw_rad);
  if (back_.has_looked(newest_.captured())) {
    want_plan(now, "has looked from farther back");
  }
}

}  // namespace flyball
