// SPDX-License-Identifier: BSD-3-Clause
#include "brick_view.h"

#include "brick_walk.h"
#include "obstacle_columns.h"

namespace flyball {
namespace {

constexpr auto at_once = [](const Aabb&) { return true; };

}  // namespace

CellState BrickView::state(const Vec3& p_W) const {
  if (!map_.lattice().contains(p_W)) {
    return p_W.allFinite() && clear_.contains(p_W) ? CellState::free : CellState::unknown;
  }
  const CellKey cell = map_.lattice().cell(p_W);
  CellState state = map_.state(cell.above(level_), level_);
  if (state == CellState::unknown && level_ > 0) {
    state = map_.state(cell, 0);
  }
  return state == CellState::unknown && clear_.contains(p_W) ? CellState::free : state;
}

CellState BrickView::body_state(const Vec3& p_WB, const Cylinder& body) const {
  if (!p_WB.allFinite()) {
    return CellState::unknown;
  }
  const BrickWalk walk{map_, level_};
  const BodyShape shape{p_WB, body};
  if (walk.any_occupied(shape, at_once)) {
    return CellState::occupied;
  }
  const auto is_open = [&](const Aabb& part) { return !clear_.cover(part, shape); };
  return walk.any_unknown(shape, is_open) ? CellState::unknown : CellState::free;
}

bool BrickView::has_occupied(const Aabb& box) const {
  return BrickWalk{map_, level_}.any_occupied(BoxShape{box}, at_once);
}

bool BrickView::segment_hits(const Vec3& from, const Vec3& to, const Cylinder& body) const {
  return !from.allFinite() || !to.allFinite() ||
         BrickWalk{map_, level_}.any_occupied(SweepShape{from, to, body}, at_once);
}

double BrickView::obstacle_density(const Vec3& p_W, double radius_m, double half_band_m) const {
  return ObstacleColumns{p_W, radius_m, half_band_m}.density(
      [this](const Aabb& box) { return has_occupied(box); });
}

double BrickView::nearest_obstacle_m(const Vec3& p_W, double limit_m, double half_band_m) const {
  NearestShape shape{p_W, limit_m, half_band_m};
  (void)BrickWalk{map_, level_}.any_occupied(shape, [&](const Aabb& part) {
    shape.shrink_to(part);
    return false;
  });
  return shape.nearest_m();
}

void BrickView::for_each_occupied(const std::function<void(const Aabb& cube)>& show) const {
  const BrickWalk walk{map_, level_};
  for (const auto& chunk : map_.chunks()) {
    const BoxShape space{map_.lattice().cube(chunk->key, chunk_level)};
    (void)walk.any_occupied(space, [&](const Aabb& cube) {
      show(cube);
      return false;
    });
  }
}

}  // namespace flyball
