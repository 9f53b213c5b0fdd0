// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of path_planner.h as checks: plans are looked at piece by piece on a dense map, and
/// must be found where everybody finds one.

#include "flyball/kernels/conformance/dense_map.h"
#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/random.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace flyball {

class PathPlannerConformance : public KernelConformance<PathPlanner> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({"planner.budget"}, [this] {
      check_found();
      check_not_found();
      check_shorter();
      check_refusals();
      check_work();
      check_memory();
    });
  }

 private:
  struct Scene {
    DenseMap map;
    PlanRequest request;
  };

  /// A hall of 16 m by 8 m.
  static Scene hall(std::uint64_t seed) {
    Scene scene{DenseMap{{{0, -4, 0}, {16, 4, 3}}, 0.15}, {}};
    RandomStream random{seed, "path_planner_conformance"};
    scene.request.start_W = {1.5, random.uniform(-3.0, 3.0), 1.5};
    scene.request.goal_W = {14.5, random.uniform(-3.0, 3.0), random.uniform(1.0, 2.0)};
    scene.request.bounds_W = {{0.5, -3.5, 0.5}, {15.5, 3.5, 2.5}};
    scene.request.body = {0.355, 0.13};
    scene.request.max_iterations = 4000;
    scene.request.seed = seed;
    return scene;
  }
  /// With a wall across it, and a gap of 2 m in the wall.
  static Scene walled(std::uint64_t seed, bool has_gap = true) {
    Scene scene = hall(seed);
    RandomStream random{seed, "path_planner_conformance_gap"};
    scene.map.fill({{7.95, -4, 0}, {8.1, 4, 3}}, CellState::occupied);
    if (has_gap) {
      const double from_m = random.uniform(-3.4, 1.4);
      scene.map.fill({{7.95, from_m, 0}, {8.1, from_m + 2.0, 3}}, CellState::free);
    }
    return scene;
  }
  static Scene half_unknown() {
    Scene scene = hall(3);
    scene.map.fill({{6, -4, 0}, {16, 4, 3}}, CellState::unknown);
    return scene;
  }

  Plan asked(const Scene& scene) { return made()->plan(scene.request, scene.map); }

  void check_consistent(const Plan& plan, const PlanRequest& request) {
    require(plan.waypoints_W.empty() != plan.failure.empty(),
            "neither finds a path nor says why, or both");
    require(is_countable(plan.work) &&
                plan.work.count("iterations") <= static_cast<double>(request.max_iterations),
            "takes more iterations than it may");
  }

  void check_sound(const Plan& plan, const Scene& scene) {
    check_consistent(plan, scene.request);
    const auto& points_W = plan.waypoints_W;
    if (points_W.size() < 2) {
      require(points_W.empty(), "calls a single place a path");
      return;
    }
    require(points_W.front() == scene.request.start_W && points_W.back() == scene.request.goal_W,
            "does not lead from the start to the goal");
    for (std::size_t i = 0; i + 1 < points_W.size(); ++i) {
      const Vec3 piece = points_W[i + 1] - points_W[i];
      require(!scene.map.segment_hits(points_W[i], points_W[i + 1], scene.request.body),
              "leads through an obstacle");
      require(scene.request.bounds_W.contains(points_W[i]), "leaves the bounds");
      // Shorter pieces may be steeper: they are corrections of a cell or two.
      require(piece.norm() < 0.3 || std::atan2(std::abs(piece.z()), piece.head<2>().norm()) <=
                                        scene.request.max_slope_rad + 1e-6,
              "is steeper than may be flown");
    }
    require(length_m(points_W) < scene.request.shorter_than_m, "is longer than is wanted");
  }

  void check_found() {
    std::vector<Scene> scenes{hall(1), half_unknown()};
    for (std::uint64_t seed = 10; seed < 15; ++seed) {
      scenes.push_back(walled(seed));
    }
    for (const Scene& scene : scenes) {
      const Plan plan = asked(scene);
      require(!plan.waypoints_W.empty(), "finds no path where there is an easy one");
      check_sound(plan, scene);
    }
  }

  void check_not_found() {
    Scene scene = walled(20, false);
    scene.request.max_iterations = 300;
    const Plan plan = asked(scene);
    require(plan.waypoints_W.empty(), "leads through an obstacle");
    check_consistent(plan, scene.request);
  }

  void check_shorter() {
    Scene scene = walled(21);
    scene.map.fill({{7.95, -4, 0}, {8.1, 2.0, 3}}, CellState::occupied);
    scene.map.fill({{7.95, 2.0, 0}, {8.1, 4, 3}}, CellState::free);
    scene.request.start_W.y() = scene.request.goal_W.y() = -3.0;
    const double line_m = (scene.request.goal_W - scene.request.start_W).norm();
    scene.request.shorter_than_m = 1.02 * line_m;  // The path through the gap is longer.
    scene.request.max_iterations = 300;
    check_sound(asked(scene), scene);
  }

  void check_refusals() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Scene> scenes(6, walled(22, false));
    scenes[0].request.start_W = {8.0, 0.0, 1.5};
    scenes[1].request.goal_W = {8.0, 0.0, 1.5};
    scenes[2].request.goal_W = {99.0, 0.0, 1.5};
    scenes[3].request.start_W.x() = nan;
    scenes[4].request.goal_W.z() = nan;
    scenes[5].request.goal_W.y() = std::numeric_limits<double>::infinity();
    for (Scene& scene : scenes) {
      scene.request.max_iterations = 200;
      const Plan plan = asked(scene);
      require(plan.waypoints_W.empty() && !plan.failure.empty(),
              "plans from or to a place that is blocked, out of bounds or not finite");
    }
  }

  void check_work() {
    Scene scene = walled(23, false);
    scene.request.max_iterations = 100;
    const Plan few = asked(scene);
    scene.request.max_iterations = 500;
    const Plan many = asked(scene);
    require(many.work.count("iterations") > 0.0 && many.work.count("collision_queries") > 0.0,
            "counts no iterations or no collision queries");
    require_work(many.work, few.work);
  }

  void check_memory() {
    const auto used = made();
    for (const std::uint64_t seed : {30U, 31U, 30U}) {
      const Scene scene = walled(seed);
      const Plan fresh = asked(scene);
      const Plan again = used->plan(scene.request, scene.map);
      require(fresh.waypoints_W == again.waypoints_W && is_same(fresh.work, again.work),
              "plans differently after other plans");
    }
  }
};

}  // namespace flyball
