// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Minimum-snap or minimum-jerk polynomials through knots with given directions.

#include "flyball/runtime/trajectory.h"

#include <vector>

namespace flyball {

/// A place that the curve passes, and the direction in which it does. Velocity, acceleration and
/// jerk at a knot are multiples of the direction: so the curve leaves and enters the straight
/// edges of a polygon tangentially, and between two knots of one edge it is that edge.
struct SnapKnot {
  Vec3 p_W{Vec3::Zero()};
  Vec3 direction_W{Vec3::UnitX()};  ///< Unit vector.
  /// Velocity, acceleration and jerk along the direction: given when `is_fixed`, else a first
  /// guess.
  Vec3 along{Vec3::Zero()};
  bool is_fixed{};
};

/// Finds the derivatives at the free knots that minimise the integral of the squared jerk
/// (`derivative` 3) or snap (4).
///
/// The unconstrained quadratic programme in the free end derivatives of Richter, Bry and Roy 2013
/// (doi:10.1007/978-3-319-28872-7_37, eq. 26), with one scalar instead of a vector per derivative.
/// @pre  `derivative` is 3 or 4; one duration per pair of neighbours, all positive.
/// @cost O(knots): the normal equations are block-tridiagonal.
void minimise(int derivative, std::vector<SnapKnot>& knots, const std::vector<double>& durations_s);

/// The polynomial of degree 7 between two knots.
[[nodiscard]] PolynomialPiece piece_between(const SnapKnot& from,
                                            const SnapKnot& to,
                                            double duration_s);

/// How far the last of the three control points (Bezier form) that a knot determines lies before
/// it in a piece of this duration; nothing when they do not lie one behind the other. The curve
/// stays in the hull of the control points.
/// @param forward  Whether the piece begins (else ends) at the knot.
[[nodiscard]] bool control_reach_m(const SnapKnot& knot,
                                   double duration_s,
                                   bool forward,
                                   double& reach_m);

}  // namespace flyball
