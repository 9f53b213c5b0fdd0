// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A navigator on its way along a corridor, and paths for it.

#include "flyball/flight/navigation/navigator.h"

#include "mission_rig.h"
#include <chrono>
#include <optional>
#include <vector>

namespace flyball::kit {

inline Trajectory straight(const Vec3& from, const Vec3& to) {
  PolynomialPiece piece;
  piece.duration_s = (to - from).norm();
  piece.c.col(0) = from;
  piece.c.col(1) = (to - from) / piece.duration_s;
  return {{piece}};
}

/// From corner to corner.
inline Trajectory along(const std::vector<Vec3>& corners) {
  Trajectory whole;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    whole.pieces.push_back(straight(corners[i], corners[i + 1]).pieces.front());
  }
  return whole;
}

/// Goes past the end and comes back, so that the way is longer by `more_m`.
inline Trajectory detour(const Vec3& from, const Vec3& to, double more_m) {
  const Vec3 past_W = to + 0.5 * more_m * (to - from).normalized();
  return more_m > 0.0 ? along({from, past_W, to}) : straight(from, to);
}

struct Trip {
  explicit Trip(const Scenario& scenario = MissionRig::one_core())
      : map{corridor(60.0)}, rig{map, scenario}, navigator{*rig.context} {
    navigator.hover_at(Vec3{0, 0, 1.5}, 0.0);
  }
  void tick(int n) {
    for (int i = 0; i < n; ++i) {
      now += std::chrono::milliseconds{20};
      where.X_WB.translation() = navigator.follower().position_W();
      if (i % 5 == 0) {
        navigator.map_published(now, {++revision, now - std::chrono::milliseconds{100}, now, 0.15});
      }
      (void)navigator.tick(now, std::chrono::milliseconds{20}, where);
    }
  }
  /// Flies along a straight path for 2 s, until it is blocked 25 m ahead. @return What is asked for
  /// then.
  std::optional<PlanQuery> fly_until_blocked() {
    navigator.set_goal(now, Vec3{40, 0, 1.5});
    const auto first = navigator.next_query(now);
    navigator.path_planned(now, {first->id, straight(first->start_W, first->goal_W), ""});
    tick(100);
    navigator.path_checked(now, {30.0, 25.0}, navigator.path_number());
    return navigator.next_query(now);
  }
  GridMap map;
  MissionRig rig;
  Navigator navigator;
  PoseEstimate where{};
  MissionTime now{std::chrono::seconds{1}};
  std::uint64_t revision{};
};

}  // namespace flyball::kit
