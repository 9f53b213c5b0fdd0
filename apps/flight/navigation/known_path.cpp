// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/known_path.h"

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/assert.h"

namespace flyball {

double detour_m(const std::vector<Vec3>& path_W) {
  FLYBALL_ASSERT(!path_W.empty(), "a path without a waypoint");
  return length_m(path_W) - (path_W.back() - path_W.front()).norm();
}

std::vector<Vec3> joined_to(const Vec3& start_W, const KnownPath& path, const OccupancyView& map) {
  const std::vector<Vec3>& all_W = path.waypoints_W;
  FLYBALL_ASSERT(all_W.size() >= 2, "%zu waypoints", all_W.size());
  const bool is_past = all_W.size() > 2 && (all_W[1] - start_W).dot(all_W[2] - all_W[1]) <= 0.0 &&
                       !map.segment_hits(start_W, all_W[2], path.body);
  std::vector<Vec3> joined{start_W};
  joined.insert(joined.end(), all_W.begin() + (is_past ? 2 : 1), all_W.end());
  return joined;
}

bool turns_back(const std::vector<Vec3>& path_W, const Vec3& direction_W) {
  FLYBALL_ASSERT(path_W.size() >= 2, "%zu waypoints", path_W.size());
  return (path_W[1] - path_W[0]).dot(direction_W) < 0.0;
}

}  // namespace flyball
