// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A navigator on its way along a corridor, and paths for it.

#include "flyball/flight/navigation/navigator.h"

#include "mission_rig.h"
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

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
  explicit Trip(const Scenario& scenario = MissionRig::one_core(), Site site = {})
      : map{corridor(60.0)},
        rig{map, scenario, std::move(site)},
        navigator{rig.brief, rig.kernels.path_tracker} {
    navigator.set_knobs(now, rig.knobs);
    publish_map(std::chrono::milliseconds{100});
    hover_at(Vec3{0, 0, 1.5});
  }
  void hover_at(const Vec3& p_W) { navigator.obey(now, {++commands, HoverAt{p_W, 0.0}}); }
  void set_goal(const Vec3& p_W, const std::optional<double>& yaw_rad = {}) {
    navigator.obey(now, {++commands, GoTo{p_W, yaw_rad, is_one_of_many}});
  }
  void turn(const std::string& knob, double value) {
    EXPECT_TRUE(rig.set(knob, value));
    navigator.set_knobs(now, rig.knobs);
  }
  /// A map, as the node `check` hands it on.
  void publish_map(Duration age, std::optional<double> blocked_at_m = std::nullopt) {
    const NavigatorState state = navigator.state();
    PathClearance clearance;
    clearance.revision = {++revision, now - age, cell_m,
                          other_map ? other_map : std::make_shared<const GridMap>(map)};
    clearance.published = now;
    clearance.path_number = state.path_number;
    clearance.blocked_at_m = blocked_at_m;
    if (state.has_path()) {
      clearance.free_until_m =
          known_free_until_m(map, *state.path, state.s_m, *rig.brief, *rig.knobs);
    }
    navigator.path_checked(now, clearance);
  }
  void block(double at_m) { publish_map(std::chrono::milliseconds{100}, at_m); }
  /// The plan that was asked for is a straight line.
  void answer(const PlanQuery& query) {
    navigator.path_planned(now, {query.id, straight(query.start_W, query.goal_W), ""});
  }
  void tick(int n) {
    for (int i = 0; i < n; ++i) {
      now += std::chrono::milliseconds{20};
      navigator.set_knobs(now, rig.knobs);
      where.X_WB.translation() = navigator.follower().position_W();
      where.stamp = now;
      if (i % 5 == 0) {
        publish_map(std::chrono::milliseconds{100});
      }
      (void)navigator.tick(now, std::chrono::milliseconds{20}, where);
      note(navigator.news());
    }
  }
  void note(const NavigatorNews& news) {
    for (const MapHint& told : news.map_hints) {
      if (const auto* clear = std::get_if<ClearSpace>(&told)) {
        declared_W.push_back(clear->centre_W);
      } else {
        doubted.push_back(std::get<DoubtedPlace>(told));
      }
    }
    gave_up = gave_up || news.gives_up;
    late_maps += news.map_use && news.map_use->budget_use > 1.0 ? 1 : 0;
  }
  /// Flies along a straight path for 2 s, until it is blocked 25 m ahead. @return What is asked for
  /// then.
  std::optional<PlanQuery> fly_until_blocked() {
    set_goal(Vec3{40, 0, 1.5});
    answer(*navigator.next_query(now));
    tick(100);
    block(30.0);
    return navigator.next_query(now);
  }
  GridMap map;
  std::shared_ptr<const GridMap> other_map{};  ///< Is published instead, if there is one.
  MissionRig rig;
  Navigator navigator;
  PoseEstimate where{};
  MissionTime now{std::chrono::seconds{1}};
  double cell_m{0.15};
  std::uint64_t revision{};
  std::uint64_t commands{};
  bool is_one_of_many{};           ///< Of `set_goal`.
  std::vector<Vec3> declared_W{};  ///< Clear space that the navigator has told of.
  std::vector<DoubtedPlace> doubted{};
  bool gave_up{};
  int late_maps{};
};

}  // namespace flyball::kit
