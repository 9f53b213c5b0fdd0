// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/path_break.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <iterator>

namespace flyball {
namespace {

constexpr double step_m = 1.0;     // Chosen: a body's width or two behind the break is near enough.
constexpr double farthest_m = 60;  // Chosen: on longer edges it is looked for near the break's end.

}  // namespace

std::optional<PathBreak> break_of(const std::vector<Vec3>& path_W,
                                  const OccupancyView& map,
                                  const Cylinder& body,
                                  double& queries) {
  FLYBALL_ASSERT(path_W.size() >= 2, "%zu waypoints", path_W.size());
  const auto is_blocked = [&](const Vec3& from_W, const Vec3& to_W) {
    queries += 1.0;
    return map.segment_hits(from_W, to_W, body);
  };
  std::size_t first = 0;
  while (first + 1 < path_W.size() && !is_blocked(path_W[first], path_W[first + 1])) {
    ++first;
  }
  PathBreak found;
  found.before_W.assign(path_W.begin(), path_W.begin() + static_cast<std::ptrdiff_t>(first) + 1);
  if (first + 1 == path_W.size()) {
    return found;
  }
  std::size_t last = path_W.size() - 1;  // The first corner behind the break.
  if (is_blocked(path_W[last], path_W[last])) {
    return std::nullopt;
  }
  while (last > first + 1 && !is_blocked(path_W[last - 1], path_W[last])) {
    --last;
  }
  // Back along the last blocked edge, as far as its rest is free.
  const Vec3 edge = path_W[last - 1] - path_W[last];
  const double edge_m = edge.norm();
  double back_m = 0.0;
  while (back_m + step_m < std::min(edge_m, farthest_m) &&
         !is_blocked(path_W[last] + (back_m + step_m) / edge_m * edge, path_W[last])) {
    back_m += step_m;
  }
  if (back_m > 0.0) {
    found.behind_W.push_back(path_W[last] + back_m / edge_m * edge);
  }
  found.behind_W.insert(found.behind_W.end(), path_W.begin() + static_cast<std::ptrdiff_t>(last),
                        path_W.end());
  return found;
}

}  // namespace flyball
