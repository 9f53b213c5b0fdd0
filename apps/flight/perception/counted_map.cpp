// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/counted_map.h"

namespace flyball {

CellState CountedMap::state(const Vec3& p_W) const {
  ++cells_;
  return map_.state(p_W);
}

CellState CountedMap::body_state(const Vec3& p_WB, const Cylinder& body) const {
  ++poses_;
  return map_.body_state(p_WB, body);
}

bool CountedMap::has_occupied(const Aabb& box) const {
  ++collision_queries_;
  return map_.has_occupied(box);
}

bool CountedMap::segment_hits(const Vec3& from, const Vec3& to, const Cylinder& body) const {
  ++collision_queries_;
  return map_.segment_hits(from, to, body);
}

double CountedMap::obstacle_density(const Vec3& p_W, double radius_m, double half_band_m) const {
  ++densities_;
  return map_.obstacle_density(p_W, radius_m, half_band_m);
}

double CountedMap::nearest_obstacle_m(const Vec3& p_W, double limit_m, double half_band_m) const {
  ++distances_;
  return map_.nearest_obstacle_m(p_W, limit_m, half_band_m);
}

void CountedMap::add_to(Work& work) const {
  const auto add = [&](const char* name, double count) {
    if (count > 0.0) {
      work.add(name, count);
    }
  };
  add("cells", cells_);
  add("poses", poses_);
  add("collision_queries", collision_queries_);
  add("densities", densities_);
  add("distances", distances_);
}

}  // namespace flyball
