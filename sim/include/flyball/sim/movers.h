// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Solids that move: where they are depends on the mission's time alone.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/time.h"

#include <vector>

namespace flyball {

/// An upright box that goes to and fro between two places at a steady speed.
struct Mover {
  Vec3 size_m{Vec3::Zero()};
  Vec3 from_W{Vec3::Zero()};  ///< Middle of its foot,
  Vec3 to_W{Vec3::Zero()};    ///< there and back.
  double speed_m_s{};
  double ahead_m{};  ///< How far along its path it is at first.
};

[[nodiscard]] Aabb box_at(const Mover& mover, MissionTime now);

/// From the body to the nearest of them, at most `limit_m`; zero when they touch or overlap.
[[nodiscard]] double clearance_m(const std::vector<Mover>& movers,
                                 MissionTime now,
                                 const Vec3& p_WB,
                                 const Cylinder& body,
                                 double limit_m);

/// Distance from `from_W` to where the ray enters the box, in units of `direction_W`; infinity when
/// it does not, zero from inside.
[[nodiscard]] double ray_enters(const Aabb& box, const Vec3& from_W, const Vec3& direction_W);

}  // namespace flyball
