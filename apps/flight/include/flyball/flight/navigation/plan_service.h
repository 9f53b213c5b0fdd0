// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The messages between the navigator and what plans for it.

#include "flyball/flight/navigation/known_path.h"
#include "flyball/runtime/numbers.h"
#include "flyball/runtime/trajectory.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

struct PlanQuery {
  std::uint64_t id{};
  Vec3 start_W{Vec3::Zero()};
  Vec3 start_direction_W{Vec3::Zero()};  ///< Zero: from a standstill.
  Vec3 goal_W{Vec3::Zero()};
  int failures{};        ///< Searches that found no path since one was last adopted.
  bool may_be_tight{};   ///< Only the tube of slow flight has to fit.
  double iteration_s{};  ///< Time of one iteration in the last searches; 0: not known.
  /// From the start along the way by which the vehicle came from the goal, or empty.
  std::vector<Vec3> flown_W{};
  /// A path that was found before and is to be joined from `start_W`: nothing is searched for.
  std::optional<KnownPath> known{};
  bool may_turn_back{true};  ///< To join it; else a path that would have to is refused.
};

struct PlanAnswer {
  std::uint64_t id{};
  std::vector<Vec3> waypoints_W{};  ///< Empty: `failure` says why.
  Vec3 start_direction_W{Vec3::Zero()};
  Cylinder body{};  ///< The body, with its tube, that the path was planned for.
  std::string failure{};
  double iterations{};
};

/// On a link: a path's way-points, beside the members of fixed size.
[[nodiscard]] inline double wire_bytes(const PlanQuery& query) {
  const std::size_t known = query.known ? query.known->waypoints_W.size() : 0;
  return static_cast<double>(sizeof(PlanQuery) + (known + query.flown_W.size()) * sizeof(Vec3));
}
[[nodiscard]] inline double wire_bytes(const PlanAnswer& answer) {
  return static_cast<double>(sizeof(PlanAnswer) + answer.waypoints_W.size() * sizeof(Vec3) +
                             answer.failure.size());
}

/// Its way-points.
inline void visit_numbers(PlanAnswer& answer, NumberVisitor& visitor) {
  for (Vec3& p_W : answer.waypoints_W) {
    visit_vector(visitor, {"x", "y", "z"}, Quantity::position, p_W);
  }
}

struct PlannedPath {
  std::uint64_t id{};
  Trajectory trajectory{};
  std::string failure{};
  bool map_moved_on{};  ///< It failed on a newer map than it was planned on: plan again at once.
  KnownPath path{};     ///< The path that the trajectory follows.
  double iterations{};  ///< Iterations that the search took.
};

/// Where each piece of its trajectory begins; the polynomials' other coefficients stay.
inline void visit_numbers(PlannedPath& planned, NumberVisitor& visitor) {
  for (PolynomialPiece& piece : planned.trajectory.pieces) {
    Vec3 begin_W = piece.c.col(0);
    visit_vector(visitor, {"x", "y", "z"}, Quantity::position, begin_W);
    piece.c.col(0) = begin_W;
  }
}

}  // namespace flyball
