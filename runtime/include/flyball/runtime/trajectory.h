// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Piecewise polynomial trajectories, and the same curve by arc length. A smoother makes the
/// former; the tracker flies the latter at the speed that latency allows.

#include "flyball/runtime/geometry.h"

#include <vector>

namespace flyball {

/// p(t) = sum_k c.col(k) t^k for t in [0, duration_s].
struct PolynomialPiece {
  Eigen::Matrix<double, 3, 8> c{Eigen::Matrix<double, 3, 8>::Zero()};
  double duration_s{};

  /// The n-th derivative at `t_s`; n = 0 is the position.
  [[nodiscard]] Vec3 derivative(int n, double t_s) const;
};

struct Trajectory {
  std::vector<PolynomialPiece> pieces{};

  [[nodiscard]] double duration_s() const;
  /// The n-th derivative at `t_s`, clamped to the trajectory's ends.
  [[nodiscard]] Vec3 derivative(int n, double t_s) const;
};

/// A curve sampled by arc length (chord step at most `step_m`). Between samples it is linear in
/// position, tangent and curvature. A corner is a place, not a stretch: its sample has the tangent
/// that leaves it, and `at` just before and behind it answers with the finite curvature there.
class Path {
 public:
  struct Sample {
    double s_m{};
    Vec3 p_W{Vec3::Zero()};
    Vec3 tangent_W{Vec3::UnitX()};
    double curvature_1_m{};  ///< Infinity at a corner (where the trajectory stops).
  };

  Path() = default;
  /// @pre `step_m > 0`.
  Path(const Trajectory& trajectory, double step_m = 0.05);
  /// The part of `head` in [from_m, to_m], then `tail` (over a straight line when it starts
  /// elsewhere). A kink between them gets infinite curvature.
  static Path joined(const Path& head, double from_m, double to_m, const Path& tail);
  /// Straight lines between the points; a corner has infinite curvature.
  static Path polyline(const std::vector<Vec3>& points_W, double step_m = 0.05);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  [[nodiscard]] double length_m() const { return samples_.empty() ? 0.0 : samples_.back().s_m; }
  /// Clamped to the path's ends. @pre not empty.
  [[nodiscard]] Sample at(double s_m) const;
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }

 private:
  void append(const Vec3& p_W, const Vec3& tangent_W, double curvature_1_m);
  void append_tail(const Path& tail);
  /// Leaves the last sample in a new direction.
  void bend(const Vec3& tangent_W);
  void finish_ends();
  std::vector<Sample> samples_;
};

/// What lies ahead on a path, by arc length. The path outlives it.
struct PathSpan {
  const Path* path{};
  double from_m{};
  double horizon_m{};  ///< From `from_m` on.
};

}  // namespace flyball
