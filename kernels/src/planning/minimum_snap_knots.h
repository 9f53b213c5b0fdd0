// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A polygon as knots of a minimum-snap curve: its edges stay straight, its corners are rounded.

#include "planning/minimum_snap_solver.h"
#include <cstddef>
#include <vector>

namespace flyball {

struct SpeedLimits {
  double max_speed_m_s{};
  double max_acceleration_m_s2{};
};

/// What is asked of the curve.
struct RoundedPolygon {
  std::vector<Vec3> points_W{};  ///< At least two, no neighbours equal.
  Vec3 start_velocity_W{Vec3::Zero()};
  SpeedLimits limits{};
  /// Per point, how far before and after it the curve leaves the edges; 0: it stops there. At the
  /// first point: how far along the first edge it bends in from the direction of the start
  /// velocity; 0: it starts along the edge.
  std::vector<double> cut_m{};
};

struct SnapKnots {
  std::vector<SnapKnot> knots{};
  std::vector<double> durations_s{};
  std::vector<int> corner{};  ///< Per piece: the point that it rounds; -1 on a straight edge.
};

/// Largest useful cuts: as much as the fastest round needs, at most nearly half of an edge, so that
/// curves stay local; nearly all of the first one, where the path comes straight on.
/// Zero where the polygon turns back too sharply to be rounded.
[[nodiscard]] std::vector<double> largest_cuts(const RoundedPolygon& polygon);
/// Where the curve may turn from the direction of the start velocity towards the second point:
/// places straight ahead of the start, the one with the widest curve first. A curve that bends in
/// from the start has to turn back onto the edge, and does so within its cut; with such a corner it
/// turns once only. Empty where bending in is no tighter.
[[nodiscard]] std::vector<Vec3> lead_ins_W(const RoundedPolygon& polygon);
/// Of the widest curve that bends in from the start velocity at once; 0: there is none.
[[nodiscard]] double widest_bend_m(const RoundedPolygon& polygon);
/// Of the curve at a point with the cut that it has; at the first one, of its bend.
[[nodiscard]] double curve_radius_m(const RoundedPolygon& polygon, std::size_t point);

/// A cut that is next smaller, zero when it would be a very tight curve.
[[nodiscard]] double smaller_cut(const RoundedPolygon& polygon, std::size_t point);

/// Knots and durations from trapezoidal speeds. Corners are taken at the speed that their curvature
/// allows, and the knots at their ends are fixed; those on straight edges are free.
[[nodiscard]] SnapKnots knots_of(const RoundedPolygon& polygon);

}  // namespace flyball
