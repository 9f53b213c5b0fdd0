// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/known_way.h"

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/assert.h"

namespace flyball {

double detour_m(const std::vector<Vec3>& way_W) {
  FLYBALL_ASSERT(!way_W.empty(), "a way without a place");
  return length_m(way_W) - (way_W.back() - way_W.front()).norm();
}

std::vector<Vec3> joined_to(const Vec3& start_W, const KnownWay& way, const OccupancyView& map) {
  const std::vector<Vec3>& all_W = way.waypoints_W;
  FLYBALL_ASSERT(all_W.size() >= 2, "%zu waypoints", all_W.size());
  const bool is_past = all_W.size() > 2 && (all_W[1] - start_W).dot(all_W[2] - all_W[1]) <= 0.0 &&
                       !map.segment_hits(start_W, all_W[2], way.body);
  std::vector<Vec3> joined{start_W};
  joined.insert(joined.end(), all_W.begin() + (is_past ? 2 : 1), all_W.end());
  return joined;
}

}  // namespace flyball
