// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a computation of navigation goes by.

#include "flyball/flight/brief.h"
#include "flyball/flight/mission_topics.h"
#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"

#include <vector>

namespace flyball {

/// All of it outlives the call that it is handed to.
struct Situation {
  const Brief& brief;
  const KnobsInForce& knobs;
  const OccupancyView& map;

  [[nodiscard]] double speed_limit_m_s(const Vec3& p_W) const {
    return knobs.speed_limit_m_s(brief.site, p_W);
  }
  /// The time that a path takes at the mission's speed limits. The limit of a zone counts as far as
  /// 3 m from it.
  [[nodiscard]] double least_s(const std::vector<Vec3>& path_W) const;
  /// How much longer that is than the straight line between its ends takes; less than 0 where the
  /// path leads past a slow zone, and 0 of no path.
  [[nodiscard]] double detour_s(const std::vector<Vec3>& path_W) const;
  /// In a narrow passage or a room.
  [[nodiscard]] bool is_slow_at(const Vec3& p_W) const { return speed_limit_m_s(p_W) <= slow_m_s; }
  /// Where the site's limits ask for that.
  [[nodiscard]] std::vector<Aabb> slow_zones_W() const;
};

}  // namespace flyball
