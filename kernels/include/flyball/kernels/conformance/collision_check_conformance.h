// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of collision_check.h as checks: the answers are held against a walk along the path
/// in steps of a centimetre, on maps that are looked at cell by cell.

#include "flyball/kernels/collision_check.h"
#include "flyball/kernels/conformance/dense_map.h"
#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/runtime/random.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

class CollisionCheckConformance : public KernelConformance<CollisionChecker> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({}, [this] {
      check_random_worlds();
      check_thin_obstacle();
      check_unknown();
      check_only_ahead();
      check_work();
      check_no_path();
      check_memory();
    });
  }

 private:
  static constexpr Cylinder body{0.355, 0.13};
  static constexpr double step_m = 0.01;  // Of the walk.
  // The walk may begin a step late, and a checker may cut a corner of a chord or stop a little
  // early.
  static constexpr double late_m = 0.02;
  static constexpr double early_m = 0.10;

  struct Scene {
    DenseMap map;
    Path path;
  };

  static Cylinder wider(double by_m) { return {body.radius_m + by_m, body.half_height_m + by_m}; }

  /// A circle among posts.
  static Scene scene(std::uint64_t seed) {
    RandomStream random{seed, "collision_check_conformance"};
    Scene scene{DenseMap{{{-9, -9, 0}, {9, 9, 3}}, 0.15}, {}};
    for (int i = 0; i < 5; ++i) {
      const Vec3 foot{random.uniform(-8, 8), random.uniform(-8, 8), 0.0};
      scene.map.fill({foot, foot + Vec3{0.5, 0.5, 3.0}}, CellState::occupied);
    }
    const Vec3 unknown{random.uniform(-8, 8), random.uniform(-8, 8), 0.0};
    scene.map.fill({unknown, unknown + Vec3{2.0, 2.0, 3.0}}, CellState::unknown);
    const double radius_m = random.uniform(1.0, 7.0);
    std::vector<Vec3> points_W;
    for (int i = 0; i <= 100; ++i) {
      points_W.emplace_back(radius_m * std::cos(0.06 * i), radius_m * std::sin(0.06 * i), 1.5);
    }
    scene.path = Path::polyline(points_W);
    return scene;
  }

  /// Where the body first is in a worse state than `best`; the walk's end where it never is.
  static double walked_m(
      const Scene& scene, double from_m, double to_m, const Cylinder& around, CellState best) {
    for (double s_m = from_m; s_m <= to_m; s_m += step_m) {
      if (scene.map.body_state(scene.path.at(s_m).p_W, around) > best) {
        return s_m;
      }
    }
    return to_m;
  }

  PathCheck asked(CollisionChecker& checker, const Scene& scene, double from_m, double horizon_m) {
    Work work;
    return checker.check(scene.map, {&scene.path, from_m, horizon_m}, body, work);
  }

  void check_random_worlds() {
    const auto checker = made();
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      const Scene world = scene(seed);
      const double from_m = 0.1 * world.path.length_m();
      compare(*checker, world, from_m, 6.0);
    }
  }

  void compare(CollisionChecker& checker, const Scene& world, double from_m, double horizon_m) {
    const double end_m = world.path.length_m();
    const PathCheck found = asked(checker, world, from_m, horizon_m);
    const double blocked_m = found.blocked_at_m.value_or(end_m);
    const double surely_m = walked_m(world, from_m, end_m, wider(-0.002), CellState::unknown);
    const double nearly_m = walked_m(world, from_m, end_m, wider(0.01), CellState::unknown);
    require(blocked_m <= surely_m + late_m, "misses an occupied cell that the body hits");
    require(blocked_m >= nearly_m - early_m, "reports a collision where there is none");
    const double to_m = std::min(from_m + horizon_m, end_m);
    const double unsure_m = walked_m(world, from_m, to_m, wider(-0.002), CellState::free) - from_m;
    const double free_m = walked_m(world, from_m, to_m, wider(0.01), CellState::free) - from_m;
    require(found.known_free_m <= unsure_m + 0.06, "calls space free that is not known to be");
    require(found.known_free_m >= free_m - early_m, "does not see space that is known to be free");
  }

  void check_thin_obstacle() {
    Scene world{DenseMap{{{9, -1, 1}, {11, 1, 2}}, 0.01},
                Path::polyline({{0, 0, 1.5}, {20, 0, 1.5}}, 1.0)};
    world.map.fill({{10.30, 0.30, 1.4}, {10.31, 0.35, 1.6}}, CellState::occupied);
    const auto blocked = asked(*made(), world, 0.0, 0.0).blocked_at_m;
    const double contact_m = 10.3 - std::sqrt(0.355 * 0.355 - 0.30 * 0.30);
    require(blocked && std::abs(*blocked - contact_m) < early_m,
            "misses an obstacle that is thinner than its steps");
  }

  static Scene corridor() {
    return {DenseMap{{{-1, -2, 0}, {20, 2, 3}}, 0.15}, Path::polyline({{0, 0, 1.5}, {18, 0, 1.5}})};
  }

  void check_unknown() {
    Scene world = corridor();
    world.map.fill({{10.05, -2, 0}, {20, 2, 3}}, CellState::unknown);
    const PathCheck found = asked(*made(), world, 2.0, 30.0);
    require(!found.blocked_at_m, "reports a collision with unknown space");
    require(std::abs(found.known_free_m - (10.05 - 2.0 - body.radius_m)) < early_m,
            "does not end known-free space at the first unknown cell");
    require(std::abs(asked(*made(), world, 2.0, 5.0).known_free_m - 5.0) < 1e-6,
            "does not keep to the horizon");
  }

  void check_only_ahead() {
    Scene world = corridor();
    world.map.fill({{6, -2, 0}, {6.15, 2, 3}}, CellState::occupied);
    const auto checker = made();
    require(asked(*checker, world, 3.0, 1.0).blocked_at_m.has_value(),
            "misses an occupied cell that the body hits");
    require(!asked(*checker, world, 8.0, 1.0).blocked_at_m, "looks behind the span's beginning");
    require(!asked(*checker, world, 99.0, 1.0).blocked_at_m,
            "reports a collision behind the path's end");
  }

  void check_work() {
    const Scene world = corridor();
    const auto checker = made();
    Work nearer;
    Work farther;
    static_cast<void>(checker->check(world.map, {&world.path, 15.0, 2.0}, body, nearer));
    static_cast<void>(checker->check(world.map, {&world.path, 0.0, 10.0}, body, farther));
    require(nearer.count("poses") > 0.0, "counts no poses");
    require_work(farther, nearer);
  }

  void check_no_path() {
    Scene world = corridor();
    world.path = {};
    const PathCheck found = asked(*made(), world, 0.0, 5.0);
    require(!found.blocked_at_m && found.known_free_m == 0.0,
            "has something to say about an empty path");
    Work work;
    const PathCheck none = made()->check(world.map, {nullptr, 0.0, 5.0}, body, work);
    require(!none.blocked_at_m && none.known_free_m == 0.0, "has something to say about no path");
  }

  void check_memory() {
    const auto used = made();
    for (std::uint64_t seed = 20; seed < 24; ++seed) {
      const Scene world = scene(seed);
      const PathCheck fresh = asked(*made(), world, 0.0, 5.0);
      const PathCheck again = asked(*used, world, 0.0, 5.0);
      require(fresh.blocked_at_m == again.blocked_at_m && fresh.known_free_m == again.known_free_m,
              "answers differently after other questions");
    }
  }
};

}  // namespace flyball
