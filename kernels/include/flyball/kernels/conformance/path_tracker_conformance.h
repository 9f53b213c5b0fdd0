// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of path_tracker.h as checks, on a straight path, a circle and a corner, whose
/// positions, velocities and accelerations are known.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/path_tracker.h"

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace flyball {

class PathTrackerConformance : public KernelConformance<PathTracker> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({}, [this] {
      check_on_the_path();
      check_feedback();
      check_corner();
      check_no_path();
      check_memory();
    });
  }

 private:
  static constexpr double radius_m = 5.0;
  static MissionTime now() { return MissionTime{std::chrono::milliseconds{1250}}; }

  static Path circle() {
    std::vector<Vec3> points_W;
    for (int i = 0; i <= 600; ++i) {
      points_W.emplace_back(radius_m * std::cos(0.01 * i), radius_m * std::sin(0.01 * i), 2.0);
    }
    return Path::polyline(points_W);
  }
  static Path line() { return Path::polyline({{0, 0, 2}, {20, 0, 2}}); }

  static PoseEstimate at(const Vec3& p_W) {
    PoseEstimate where;
    where.X_WB.translation() = p_W;
    return where;
  }

  void check_on_the_path() {
    const auto tracker = made();
    for (const Path& path : {line(), circle()}) {
      for (const double s_m : {1.0, 7.5, 15.0}) {
        const Path::Sample here = path.at(s_m);
        const Setpoint set = tracker->track(path, {s_m, 3.0, 0.5, 0.25}, at(here.p_W), now());
        require((set.p_WB - here.p_W).norm() < 1e-6, "commands a place beside the path");
        require((set.v_WB - 3.0 * here.tangent_W).norm() < 1e-6,
                "commands another velocity than the reference's");
        require(std::abs(set.a_WB.dot(here.tangent_W) - 0.5) < 0.05,
                "does not feed the reference's acceleration forward");
        require(set.stamp == now(), "does not stamp the set-point");
        require(set.yaw_rad == 0.25, "does not command the reference's yaw");
      }
    }
  }

  void check_feedback() {
    const auto tracker = made();
    const Path path = line();
    for (const Vec3& off_m : {Vec3{0, 0.3, 0}, Vec3{0, 0, -0.3}, Vec3{0.2, -0.2, 0.1}}) {
      const Vec3 here = path.at(5.0).p_W;
      const Setpoint set = tracker->track(path, {5.0, 3.0, 0.0, 0.0}, at(here + off_m), now());
      const Vec3 correction = set.v_WB - Vec3{3.0, 0, 0};
      require(correction.dot(-off_m) > 0.0, "does not correct towards the path");
    }
    const Setpoint far = tracker->track(path, {5.0, 3.0, 0.0, 0.0}, at({0, 500, 2}), now());
    require(far.v_WB.allFinite() && far.v_WB.norm() < 50.0,
            "turns a jump of the estimate into a jump of the vehicle");
  }

  void check_corner() {
    const auto tracker = made();
    const Path path = Path::polyline({{0, 0, 2}, {10, 0, 2}, {10, 10, 2}});
    for (int i = -20; i <= 20; ++i) {
      const double s_m = 10.0 + 0.01 * i;  // The corner itself, too.
      const Setpoint set = tracker->track(path, {s_m, 0.05, 0.0, 0.0}, at(path.at(s_m).p_W), now());
      require(set.p_WB.allFinite() && set.v_WB.allFinite() && set.a_WB.allFinite() &&
                  set.a_WB.norm() < 5.0,
              "asks for something impossible at a corner");
    }
  }

  void check_no_path() {
    const Setpoint set = made()->track(Path{}, {}, at({1, 2, 3}), now());
    require(set.p_WB == Vec3(1, 2, 3) && set.v_WB.isZero(), "moves without a path");
  }

  /// One that learns in flight may; the next mission's must not begin with it.
  void check_memory() {
    const auto flown = [this] {
      const auto tracker = made();
      Setpoint last;
      for (int i = 0; i < 20; ++i) {
        last = tracker->track(circle(), {0.5 * i, 2.0, 0.0, 0.0}, at({4.8, 0.4 * i, 2.1}), now());
      }
      return last;
    };
    const Setpoint first = flown();
    const Setpoint second = flown();
    require(first.p_WB == second.p_WB && first.v_WB == second.v_WB && first.a_WB == second.a_WB,
            "begins a mission with what it learnt in another one");
  }
};

}  // namespace flyball
