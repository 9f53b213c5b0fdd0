// SPDX-License-Identifier: BSD-3-Clause
#include "brick_view.h"

#include "box_words.h"
#include "brick_walk.h"
#include "inflation.h"
#include "obstacle_columns.h"

namespace flyball {
namespace {

constexpr auto at_once = [](const Aabb&) { return true; };

/// Which columns of cells a body's disc overlaps, as BodyShape::overlaps says it of each cell.
class DiscColumns {
 public:
  DiscColumns(const Lattice& lattice, const BodyShape& shape, const BoxWords& words)
      : squared_reach_m2_{shape.squared_reach_m2()} {
    const CellKey first = words.first_cell();
    for (int i = 0; i < words.cells_along_x(); ++i) {
      squared_x_m2_[static_cast<std::size_t>(i)] =
          squared_gap_m2(lattice.side(first.x + i), shape.focus().x());
    }
    for (int i = 0; i < words.cells_along_y(); ++i) {
      squared_y_m2_[static_cast<std::size_t>(i)] =
          squared_gap_m2(lattice.side(first.y + i), shape.focus().y());
    }
  }
  [[nodiscard]] bool overlaps(int x, int y) const {
    return squared_x_m2_[static_cast<std::size_t>(x)] + squared_y_m2_[static_cast<std::size_t>(y)] <
           squared_reach_m2_;
  }

 private:
  static double squared_gap_m2(const std::array<double, 2>& side_m, double x_m) {
    const double gap = gap_m(side_m[0], side_m[1], x_m);
    return gap * gap;
  }
  double squared_reach_m2_;
  std::array<double, BoxWords::most_cells> squared_x_m2_;
  std::array<double, BoxWords::most_cells> squared_y_m2_;
};

}  // namespace

/// Of a finest cell, at the active level.
inline CellState BrickView::seen_at(const CellKey& cell) const {
  const Chunk& chunk = map_.chunk_at(cell.above(chunk_level));
  const std::size_t brick = brick_number(cell.above(brick_level));
  const unsigned bit = bit_in_brick(cell);
  // No branch on what is found: 2 where it is occupied, else 1 where it is unknown.
  const std::uint64_t is_occupied = occupied_at(level_, chunk, brick) >> bit & 1U;
  const std::uint64_t is_unknown = chunk.masks[brick].unknown >> bit & 1U;
  return static_cast<CellState>(is_occupied << 1U | (is_unknown & ~is_occupied));
}

CellState BrickView::state(const Vec3& p_W) const {
  const CellState seen =
      map_.lattice().contains(p_W) ? seen_at(map_.lattice().cell(p_W)) : CellState::unknown;
  if (clear_.is_empty() || seen != CellState::unknown) {
    return seen;
  }
  return p_W.allFinite() && clear_.contains(p_W) ? CellState::free : CellState::unknown;
}

CellState BrickView::body_state(const Vec3& p_WB, const Cylinder& body) const {
  if (!p_WB.allFinite()) {
    return CellState::unknown;
  }
  const BodyShape shape{p_WB, body};
  const BoxWords words{map_, level_, shape.bounds(), touch_m};
  const BrickWalk walk{map_, level_};
  if (words.fits()) {
    const CellState seen = seen_by(shape, words);
    if (seen != CellState::unknown || clear_.is_empty()) {
      return seen;
    }
  } else if (walk.any_occupied(shape, at_once)) {
    return CellState::occupied;
  }
  const auto is_open = [&](const Aabb& part) { return !clear_.cover(part, shape); };
  return walk.any_unknown(shape, is_open) ? CellState::unknown : CellState::free;
}

/// The worst state in the body's box, or, where that is not free, in its disc's columns.
CellState BrickView::seen_by(const BodyShape& shape, const BoxWords& words) const {
  if (!words.has_occupied() && !words.has_unknown()) {
    return CellState::free;
  }
  const DiscColumns disc{map_.lattice(), shape, words};
  const auto is_in_disc = [&](int x, int y) { return disc.overlaps(x, y); };
  return words.any_occupied(is_in_disc)  ? CellState::occupied
         : words.any_unknown(is_in_disc) ? CellState::unknown
                                         : CellState::free;
}

bool BrickView::has_occupied(const Aabb& box) const {
  const BoxWords words{map_, level_, box, touch_m};
  return words.fits() ? words.has_occupied()
                      : BrickWalk{map_, level_}.any_occupied(BoxShape{box}, at_once);
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

void BrickView::inflate(const Aabb& box_W,
                        const Cylinder& body,
                        Obstruction by,
                        InflatedWindow& window) const {
  Inflation{{map_, clear_, level_, by}}.grow(box_W, body, window);
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
