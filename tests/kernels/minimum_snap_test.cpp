// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/kernels/smoother.h"
#include "flyball/runtime/registry.h"

#include "plan_scenes.h"
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

using flyball::ErrorCode;
using flyball::Path;
using flyball::SmoothPath;
using flyball::SmoothRequest;
using flyball::Trajectory;
using flyball::Vec3;
using flyball::kit::GridMap;
using flyball::kit::Scene;

flyball::Registry kernels() {
  flyball::Registry registry;
  flyball::register_kernels(registry);
  return registry;
}

std::unique_ptr<flyball::Smoother> smoother() {
  return kernels().make<flyball::Smoother>("minimum_snap");
}

SmoothRequest request_along(std::vector<Vec3> points_W) {
  SmoothRequest request;
  request.waypoints_W = std::move(points_W);
  request.max_speed_m_s = 10.0;
  request.max_acceleration_m_s2 = 3.0;
  request.body = flyball::kit::slow_body();
  return request;
}

/// Nothing anywhere.
GridMap open_space() {
  return {{{0, 0, 0}, {1, 1, 1}}, 0.15};
}

SmoothPath smoothed(const SmoothRequest& request) {
  auto result = smoother()->smooth(request, open_space());
  EXPECT_TRUE(result.ok());
  return result.ok() ? *result : SmoothPath{};
}

int stops(const Path& path) {
  return static_cast<int>(
      std::count_if(path.samples().begin(), path.samples().end(),
                    [](const Path::Sample& sample) { return std::isinf(sample.curvature_1_m); }));
}

double distance_to_polygon(const Vec3& p, const std::vector<Vec3>& points) {
  double nearest = (p - points.front()).norm();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 piece = points[i + 1] - points[i];
    const double u = std::clamp((p - points[i]).dot(piece) / piece.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (points[i] + u * piece - p).norm());
  }
  return nearest;
}

/// Ends, limits and continuity: what holds for every curve.
void expect_sound(const Trajectory& trajectory, const SmoothRequest& request) {
  const double end_s = trajectory.duration_s();
  ASSERT_TRUE(std::isfinite(end_s));
  EXPECT_LT((trajectory.derivative(0, 0.0) - request.waypoints_W.front()).norm(), 1e-9);
  EXPECT_LT((trajectory.derivative(0, end_s) - request.waypoints_W.back()).norm(), 1e-9);
  EXPECT_LT(trajectory.derivative(1, end_s).norm(), 1e-6);
  double top_speed = 0.0;
  double top_acceleration = 0.0;
  constexpr int samples = 2000;
  for (int i = 0; i <= samples; ++i) {
    const double t = end_s * i / samples;
    top_speed = std::max(top_speed, trajectory.derivative(1, t).norm());
    top_acceleration = std::max(top_acceleration, trajectory.derivative(2, t).norm());
  }
  EXPECT_LE(top_speed, 1.02 * request.max_speed_m_s);
  EXPECT_LE(top_acceleration, 1.02 * request.max_acceleration_m_s2);
  for (std::size_t i = 0; i + 1 < trajectory.pieces.size(); ++i) {
    const auto& before = trajectory.pieces[i];
    const auto& after = trajectory.pieces[i + 1];
    for (int n = 0; n <= 2; ++n) {
      const Vec3 jump = after.derivative(n, 0.0) - before.derivative(n, before.duration_s);
      EXPECT_LT(jump.norm(), 1e-6) << "piece " << i << " derivative " << n;
    }
  }
}

class Smoothers : public testing::TestWithParam<std::string> {};

TEST_P(Smoothers, fly_collision_free_curves_within_limits_in_random_worlds) {
  const auto registry = kernels();
  const auto planner = registry.make<flyball::PathPlanner>("rrt_connect");
  const auto smooth = registry.make<flyball::Smoother>(GetParam());
  int curves = 0;
  int corners = 0;
  int stopped = 0;
  for (std::uint64_t seed = 100; seed < 150; ++seed) {
    const Scene scene = flyball::kit::random_world(seed);
    const auto plan = planner->plan(scene.request, scene.map);
    if (plan.waypoints_W.empty()) {
      continue;
    }
    SmoothRequest request = request_along(plan.waypoints_W);
    const auto result = smooth->smooth(request, scene.map);
    ASSERT_TRUE(result.ok()) << result.error().message;
    expect_sound(result->trajectory, request);
    const Path path{result->trajectory};
    for (std::size_t i = 0; i + 1 < path.samples().size(); ++i) {
      ASSERT_FALSE(
          scene.map.segment_hits(path.samples()[i].p_W, path.samples()[i + 1].p_W, request.body))
          << "seed " << seed << " at " << path.samples()[i].s_m;
    }
    ++curves;
    corners += static_cast<int>(plan.waypoints_W.size()) - 2;
    stopped += stops(path);
  }
  EXPECT_GE(curves, 48);
  EXPECT_GT(corners, 40);
  EXPECT_LT(stopped, corners / 4);  // most corners are rounded, not stopped at
}

TEST_P(Smoothers, pass_narrow_doors_without_hitting_the_frame) {
  const auto registry = kernels();
  const auto smooth = registry.make<flyball::Smoother>(GetParam());
  const auto planner = registry.make<flyball::PathPlanner>("rrt_connect");
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Scene scene = flyball::kit::office(3, seed);
    const auto plan = planner->plan(scene.request, scene.map);
    ASSERT_FALSE(plan.waypoints_W.empty());
    const SmoothRequest request = request_along(plan.waypoints_W);
    const auto result = smooth->smooth(request, scene.map);
    ASSERT_TRUE(result.ok());
    expect_sound(result->trajectory, request);
    const Path path{result->trajectory};
    for (std::size_t i = 0; i + 1 < path.samples().size(); ++i) {
      ASSERT_FALSE(
          scene.map.segment_hits(path.samples()[i].p_W, path.samples()[i + 1].p_W, request.body))
          << "seed " << seed << " at " << path.samples()[i].s_m;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels,
                         Smoothers,
                         testing::Values("minimum_jerk", "minimum_snap"),
                         [](const auto& one) { return one.param; });

TEST(MinimumSnap, keeps_long_edges_straight_and_curves_local) {
  const auto request = request_along({{0, 0, 1.5}, {300, 0, 1.5}, {300, 40, 1.5}, {340, 40, 3}});
  const SmoothPath smooth = smoothed(request);
  expect_sound(smooth.trajectory, request);
  const Path path{smooth.trajectory};
  EXPECT_EQ(stops(path), 0);
  for (const auto& sample : path.samples()) {
    const double off_m = distance_to_polygon(sample.p_W, request.waypoints_W);
    EXPECT_LT(off_m, 2.0);
    if (sample.p_W.x() < 290.0) {
      EXPECT_LT(off_m, 1e-9);
    }
    EXPECT_GE(sample.p_W.z(), 1.5 - 1e-9);
    EXPECT_LE(sample.p_W.z(), 3.0 + 1e-9);
  }
  // 300 m at 10 m/s take 30 s and some more to speed up; a single polynomial would need 66 s.
  const auto straight = request_along({{0, 0, 1.5}, {300, 0, 1.5}});
  EXPECT_LT(smoothed(straight).trajectory.duration_s(), 40.0);
}

TEST(MinimumSnap, curves_no_more_tightly_than_its_cuts_ask_for) {
  for (const double turn : {0.1, 0.5, 1.0, 1.6, 2.2}) {
    const Vec3 corner{30, 0, 1.5};
    const auto request = request_along(
        {{0, 0, 1.5}, corner, corner + 30.0 * Vec3{std::cos(turn), std::sin(turn), 0.0}});
    const Path path{smoothed(request).trajectory};
    double tightest = 0.0;
    double cut_m = 0.0;
    for (const auto& sample : path.samples()) {
      tightest = std::max(tightest, sample.curvature_1_m);
      if (distance_to_polygon(sample.p_W, request.waypoints_W) > 1e-6) {
        cut_m = std::max(cut_m, (sample.p_W - corner).norm());
      }
    }
    const double arc_radius_m = cut_m / std::tan(0.5 * turn);
    EXPECT_LT(tightest * arc_radius_m, turn < 0.7 ? 1.9 : 1.45) << turn;
  }
}

TEST(MinimumSnap, begins_in_the_direction_of_the_start_velocity) {
  for (const double turn : {0.02, 0.2, 0.8, 1.5}) {
    auto request = request_along({{0, 0, 1.5}, {20, 0, 1.5}, {25, 5, 1.5}});
    request.start_velocity_W = 2.0 * Vec3{std::cos(turn), std::sin(turn), 0.0};
    const SmoothPath smooth = smoothed(request);
    expect_sound(smooth.trajectory, request);
    const Vec3 start = smooth.trajectory.derivative(1, 0.0);
    EXPECT_GT(start.norm(), 0.3) << turn;
    EXPECT_LT((start.normalized() - request.start_velocity_W.normalized()).norm(), 1e-9) << turn;
  }
  auto back = request_along({{0, 0, 1.5}, {20, 0, 1.5}});
  back.start_velocity_W = {-3, 0, 0};  // a loop would be longer than a stop
  EXPECT_LT(smoothed(back).trajectory.derivative(1, 0.0).norm(), 1e-9);
}

double tightest_1_m(const SmoothPath& smooth, double to_m) {
  double most = 0.0;
  const Path path{smooth.trajectory};
  for (const auto& sample : path.samples()) {
    most = std::max(most, sample.s_m < to_m ? sample.curvature_1_m : 0.0);
  }
  return most;
}

// A bend that begins at once has a radius of 6 m here, and .6 m where only .6 m are free ahead.
TEST(MinimumSnap, turns_once_where_it_comes_from_another_direction) {
  auto request = request_along({{2, 0, 1.5}, {22, 0, 1.5}});
  request.start_velocity_W = {std::cos(0.2), std::sin(0.2), 0.0};
  GridMap map{{{0, -6, 0}, {30, 6, 3}}, 0.15};
  const auto wide = smoother()->smooth(request, map);
  ASSERT_TRUE(wide.ok());
  expect_sound(wide->trajectory, request);
  EXPECT_LT(tightest_1_m(*wide, 10.0), 1.0 / 20.0);
  map.fill({{5.0, 0.6, 0}, {9.0, 2.0, 3}}, flyball::CellState::occupied);
  const auto beside = smoother()->smooth(request, map);
  ASSERT_TRUE(beside.ok());
  expect_sound(beside->trajectory, request);
  EXPECT_GT(tightest_1_m(*beside, 10.0), tightest_1_m(*wide, 10.0));
  EXPECT_EQ(stops(Path{beside->trajectory}), 0);
}

double steepest_straight(const SmoothPath& smooth) {
  double steepest = 0.0;
  const Path path{smooth.trajectory};
  const auto& samples = path.samples();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Vec3 piece_W = samples[i].p_W - samples[i - 1].p_W;
    const bool is_straight = samples[i].curvature_1_m + samples[i - 1].curvature_1_m < 1e-6;
    if (is_straight && piece_W.norm() > 0.02) {
      steepest = std::max(steepest, std::abs(piece_W.z()) / piece_W.head<2>().norm());
    }
  }
  return steepest;
}

// A piece straight ahead leaves less room to climb in than the plan had.
TEST(MinimumSnap, climbs_no_more_steeply_behind_a_piece_straight_ahead) {
  auto request = request_along({{0, 0, 1.5}, {12, 0, 5.3}, {40, 0, 5.3}});
  for (const double turn : {0.1, 0.3, 0.6}) {
    request.start_velocity_W = {std::cos(turn), std::sin(turn), 0.0};
    const SmoothPath smooth = smoothed(request);
    expect_sound(smooth.trajectory, request);
    EXPECT_LT(steepest_straight(smooth), 1.001 * std::tan(request.max_slope_rad)) << turn;
    auto steeper = request;
    steeper.max_slope_rad = 1.2;
    EXPECT_GT(steepest_straight(smoothed(steeper)), std::tan(request.max_slope_rad)) << turn;
  }
}

TEST(MinimumSnap, keeps_its_bounds_where_it_comes_from_another_direction) {
  auto request = request_along({{0, 0, 1.5}, {22, 0, 1.5}});
  request.start_velocity_W = {std::cos(0.3), std::sin(0.3), 0.0};
  const auto widest_y_m = [&] {
    double most_m = 0.0;
    const Path path{smoothed(request).trajectory};
    for (const auto& sample : path.samples()) {
      most_m = std::max(most_m, sample.p_W.y());
    }
    return most_m;
  };
  EXPECT_GT(widest_y_m(), 0.5);
  request.bounds_W = {{-1.0, -0.3, 0.0}, {30.0, 0.3, 3.0}};
  EXPECT_LT(widest_y_m(), 0.36);
}

TEST(MinimumSnap, cuts_a_corner_less_where_something_stands_inside_it) {
  GridMap map{{{0, -3, 0}, {24, 24, 3}}, 0.15};
  const auto request = request_along({{2, 0, 1.5}, {20, 0, 1.5}, {20, 20, 1.5}});
  const Path wide{smoother()->smooth(request, map)->trajectory};
  map.fill({{18.0, 1.0, 0}, {19.0, 2.0, 3}}, flyball::CellState::occupied);
  const Path narrow{smoother()->smooth(request, map)->trajectory};
  EXPECT_EQ(stops(wide), 0);
  EXPECT_EQ(stops(narrow), 0);
  EXPECT_GT(narrow.length_m(), wide.length_m());
  map.fill({{17.0, 0.45, 0}, {19.5, 3.0, 3}}, flyball::CellState::occupied);
  const Path close{smoother()->smooth(request, map)->trajectory};
  EXPECT_GT(close.length_m(), narrow.length_m());
  EXPECT_LT(close.length_m(), 38.0);
}

TEST(MinimumSnap, stops_where_the_path_turns_back) {
  const auto request = request_along({{2, 0, 1.5}, {20, 0, 1.5}, {4, 2, 1.5}});
  const SmoothPath smooth = smoothed(request);
  expect_sound(smooth.trajectory, request);
  EXPECT_EQ(stops(Path{smooth.trajectory}), 1);
  const auto& pieces = smooth.trajectory.pieces;
  EXPECT_EQ(std::count_if(pieces.begin() + 1, pieces.end(),
                          [&](const flyball::PolynomialPiece& piece) {
                            return piece.derivative(0, 0.0) == request.waypoints_W[1] &&
                                   piece.derivative(1, 0.0).norm() < 1e-9;
                          }),
            1);
}

TEST(MinimumSnap, survives_repeated_points_tiny_edges_and_sharp_turns) {
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, 1}, {1e-3, 0, 1}, {1e-3, 1e-8, 1}, {5, 0, 1}};
  points.insert(points.end(), {{5.001, 0.001, 1}, {0, 0.5, 1}, {300, 0.5, 4}, {300, 0.5, 4}});
  const auto request = request_along(points);
  expect_sound(smoothed(request).trajectory, request);
}

TEST(MinimumSnap, takes_sixty_way_points) {
  std::vector<Vec3> points;
  flyball::RandomStream random{3, "sixty"};
  for (int i = 0; i < 60; ++i) {
    points.push_back(
        {2.0 * i + random.uniform(0.0, 1.9), random.uniform(-4.0, 4.0), random.uniform(1.0, 1.5)});
  }
  const auto request = request_along(points);
  const SmoothPath smooth = smoothed(request);
  expect_sound(smooth.trajectory, request);
  const Path path{smooth.trajectory};
  for (const auto& sample : path.samples()) {
    ASSERT_LT(distance_to_polygon(sample.p_W, points), 1.0);
  }
  EXPECT_EQ(smooth.work.count("pieces"), static_cast<double>(smooth.trajectory.pieces.size()));
  EXPECT_GE(smooth.work.count("solves"), 1.0);
  EXPECT_GE(smooth.work.count("collision_queries"), 59.0);
}

TEST(MinimumSnap, refuses_what_cannot_be_flown) {
  const auto code = [](const SmoothRequest& request,
                       const GridMap& map) -> std::optional<ErrorCode> {
    const auto result = smoother()->smooth(request, map);
    return result.ok() ? std::nullopt : std::optional{result.error().code};
  };
  GridMap map{{{0, -3, 0}, {12, 3, 3}}, 0.15};
  EXPECT_EQ(code(request_along({}), map), ErrorCode::invalid_input);
  EXPECT_EQ(code(request_along({{1, 0, 1}}), map), ErrorCode::invalid_input);
  EXPECT_EQ(code(request_along({{1, 0, 1}, {1, 0, 1}}), map), ErrorCode::invalid_input);
  EXPECT_EQ(code(request_along({{1, 0, 1}, {NAN, 0, 1}}), map), ErrorCode::invalid_input);
  auto request = request_along({{1, 0, 1}, {11, 0, 1}});
  request.max_speed_m_s = 0.0;
  EXPECT_EQ(code(request, map), ErrorCode::invalid_input);
  request.max_speed_m_s = 5.0;
  map.fill({{6, -3, 0}, {6.15, 3, 3}}, flyball::CellState::occupied);
  EXPECT_EQ(code(request, map), ErrorCode::failed);
}

}  // namespace
