// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/sub_goal.h"

namespace flyball {
namespace {

// Chosen: candidates 3 m apart to both sides, up to 12 m, and every 2.5 m along the line.
constexpr double step_m = 2.5;
constexpr double nearest_share = 0.5;  // Of the horizon: nearer goals would make short legs.
constexpr double side_step_m = 3.0;
constexpr int most_aside = 4;
constexpr double least_leg_m = 5.0;  // Chosen: a search takes as long as the flight of so many.
constexpr double body_band_m = 0.3;  // A little more than half the body's height.
// Unknown space nearer to an obstacle may be the obstacle's inside: RoboRun's blocks are 4 m wide.
constexpr double unknown_gap_m = 3.0;

bool may_be_there(const Situation& situation, const Vec3& p_W) {
  if (!situation.brief.site.bounds_W.contains(p_W)) {
    return false;
  }
  const CellState state = situation.map.body_state(p_W, situation.brief.narrow_body());
  return state == CellState::free ||
         (state == CellState::unknown &&
          situation.map.nearest_obstacle_m(p_W, unknown_gap_m, body_band_m) >= unknown_gap_m);
}

}  // namespace

Vec3 sub_goal_W(const Situation& situation, const Vec3& start_W, const Vec3& goal_W, int failures) {
  const double horizon_m = situation.brief.settings.planner.horizon_m;
  const double distance_m = (goal_W - start_W).norm();
  if (horizon_m <= 0.0 || distance_m <= horizon_m) {
    return goal_W;
  }
  const Vec3 ahead_W = (goal_W - start_W) / distance_m;
  const Vec3 left_W = Vec3::UnitZ().cross(ahead_W);
  const auto is_next = [&](Vec3& p_W) {
    p_W.z() = goal_W.z();
    return may_be_there(situation, p_W) && failures-- <= 0;
  };
  for (int place = 0; place <= 2 * most_aside; ++place) {
    const double aside = side_step_m * (place % 2 == 1 ? (place + 1) / 2 : -(place / 2));
    for (double on_m = horizon_m; on_m >= nearest_share * horizon_m; on_m -= step_m) {
      if (Vec3 p_W = start_W + on_m * ahead_W + aside * left_W; is_next(p_W)) {
        return p_W;
      }
    }
  }
  return goal_W;
}

std::vector<Vec3> free_leg_W(const Situation& situation, std::vector<Vec3> flown_W) {
  const Cylinder body = situation.brief.narrow_body();
  double leg_m = 0.0;
  std::size_t free = 0;
  while (free + 1 < flown_W.size() &&
         !situation.map.segment_hits(flown_W[free], flown_W[free + 1], body)) {
    leg_m += (flown_W[free + 1] - flown_W[free]).norm();
    ++free;
  }
  if (flown_W.empty() || (free + 1 < flown_W.size() && leg_m < least_leg_m)) {
    return {};
  }
  flown_W.resize(free + 1);
  return flown_W;
}

}  // namespace flyball
