// SPDX-License-Identifier: BSD-3-Clause
#include "maps/layered_view.h"

#include "bricks/box_words.h"
#include "bricks/brick_walk.h"
#include "bricks/obstacle_columns.h"
#include <algorithm>

namespace flyball {
namespace {

double cell_m(const BrickCells& map) {
  return map.lattice().cell_m(0);
}

CellState state_in(const BrickCells& map, const Vec3& p_W) {
  return map.lattice().contains(p_W) ? map.state(map.lattice().cell(p_W), 0) : CellState::unknown;
}

BrickWalk walk_in(const BrickCells& map) {
  return BrickWalk{map, 0};
}

/// What a box of cells in a map has, as far as a look at bricks tells.
struct Glance {
  bool may_have_occupied{true};
  bool may_have_unknown{true};
};

Glance glance_at(const BrickCells& map, const Aabb& box) {
  KeyBox keys;
  if (!keys_in(map.lattice(), box, touch_m, keys) || keys.is_empty()) {
    return {};
  }
  const BoxBricks bricks{keys};
  if (!bricks.fits()) {
    return {};
  }
  const BoxWords words{map, 0, bricks};
  Glance seen{words.may_have_occupied(), words.may_have_unknown()};
  if (seen.may_have_occupied || seen.may_have_unknown) {
    seen = {false, false};
    (void)words.any_brick([&](const CellKey&, std::uint64_t occupied, std::uint64_t unknown) {
      seen.may_have_occupied = seen.may_have_occupied || occupied != 0;
      seen.may_have_unknown = seen.may_have_unknown || unknown != 0;
      return seen.may_have_occupied && seen.may_have_unknown;
    });
  }
  return seen;
}

template <class Visit>
void for_each_cube(const BrickCells& map, Visit&& visit) {
  for (const Chunk* chunk : map.chunks()) {
    (void)walk_in(map).any_occupied(BoxShape{map.lattice().cube(chunk->key, chunk_level)}, visit);
  }
}

}  // namespace

void LayeredView::forget(const BrickCells& cells) {
  const auto is_it = [&](const Layer& layer) { return layer.cells == &cells; };
  layers_.erase(std::remove_if(layers_.begin(), layers_.end(), is_it), layers_.end());
}

void LayeredView::activate(const Layer& layer) {
  forget(*layer.cells);
  layers_.insert(layers_.begin(), layer);
}

double LayeredView::resolution_m() const {
  return layers_.empty() ? initial_resolution_m : cell_m(*layers_.front().cells);
}

CellState LayeredView::state(const Vec3& p_W) const {
  if (!p_W.allFinite()) {
    return CellState::unknown;
  }
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    const CellState seen = state_in(*layers_[layer].cells, p_W);
    if (seen == CellState::occupied && !is_vague(layer, Use::move)) {
      return seen;
    }
    const BrickCells* free_cells = trusted(layer, Use::move);
    if (seen == CellState::free &&
        (free_cells == nullptr || state_in(*free_cells, p_W) == CellState::free)) {
      return seen;
    }
  }
  return clear_.contains(p_W) ? CellState::free : CellState::unknown;
}

CellState LayeredView::body_state(const Vec3& p_WB, const Cylinder& body) const {
  if (!p_WB.allFinite()) {
    return CellState::unknown;
  }
  const BodyShape shape{p_WB, body};
  if (is_plainly_free(shape.bounds())) {
    return CellState::free;
  }
  if (hits(shape, Use::move)) {
    return CellState::occupied;
  }
  const auto is_open = [&](const Aabb& part) { return !clear_.cover(part, shape); };
  return any_gap({layers_.size(), Use::move}, shape.bounds(), shape, is_open) ? CellState::unknown
                                                                              : CellState::free;
}

/// The usual case in the open: maps without an obstacle there, up to one that knows all of it.
bool LayeredView::is_plainly_free(const Aabb& box) const {
  for (std::size_t layer = 0; layer < layers_.size() && !is_vague(layer, Use::move); ++layer) {
    const Glance seen = glance_at(*layers_[layer].cells, box);
    if (seen.may_have_occupied || !seen.may_have_unknown) {
      return !seen.may_have_occupied;
    }
  }
  return false;
}

bool LayeredView::has_occupied(const Aabb& box) const {
  return hits(BoxShape{box}, Use::move);
}

bool LayeredView::segment_hits(const Vec3& from, const Vec3& to, const Cylinder& body) const {
  return !from.allFinite() || !to.allFinite() || hits(SweepShape{from, to, body}, Use::move);
}

double LayeredView::obstacle_density(const Vec3& p_W, double radius_m, double half_band_m) const {
  return ObstacleColumns{p_W, radius_m, half_band_m}.density(
      [this](const Aabb& box) { return hits(BoxShape{box}, Use::look); });
}

double LayeredView::nearest_obstacle_m(const Vec3& p_W, double limit_m, double half_band_m) const {
  NearestShape shape{p_W, limit_m, half_band_m};
  (void)any_obstacle(shape, Use::look, [&](const Aabb& part) {
    shape.shrink_to(part);
    return false;
  });
  return shape.nearest_m();
}

void LayeredView::for_each_occupied(const std::function<void(const Aabb& cube)>& show) const {
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    for_each_cube(*layers_[layer].cells, [&](const Aabb& cube) {
      if (any_gap({layer, Use::look}, cube, BoxShape{cube}, [](const Aabb&) { return true; })) {
        show(cube);
      }
      return false;
    });
  }
}

bool LayeredView::is_vague(std::size_t layer, Use use) const {
  constexpr double same = 1.001;
  return use == Use::move && cell_m(*layers_[layer].cells) > same * cell_m(*layers_.front().cells);
}

const BrickCells* LayeredView::trusted(std::size_t layer, Use use) const {
  return is_vague(layer, use) ? layers_[layer].trusted_by_finer : nullptr;
}

template <class Shape, class Show>
bool LayeredView::any_gap(Layers layers,
                          const Aabb& region,
                          const Shape& shape,
                          Show&& show) const {
  return any_gap_from(0, layers, region, shape, show);
}

template <class Shape, class Show>
bool LayeredView::any_gap_from(
    std::size_t layer, Layers layers, const Aabb& region, const Shape& shape, Show& show) const {
  if (layer == layers.count) {
    return show(region);
  }
  const auto deeper = [&](const Aabb& part) {
    return any_gap_from(layer + 1, layers, part, shape, show);
  };
  if (const BrickCells* free_cells = trusted(layer, layers.use)) {
    return walk_in(*free_cells).any_unknown(region, shape, deeper);
  }
  const auto walk = walk_in(*layers_[layer].cells);
  return walk.any_unknown(region, shape, deeper) ||
         (is_vague(layer, layers.use) && walk.any_occupied(region, shape, deeper));
}

template <class Shape, class Show>
bool LayeredView::any_obstacle(const Shape& shape, Use use, Show&& show) const {
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    const auto show_visible = [&](const Aabb& part) {
      return any_gap({layer, use}, part, shape, show);
    };
    const BrickCells& cells = *layers_[layer].cells;
    if (!is_vague(layer, use) && glance_at(cells, shape.bounds()).may_have_occupied &&
        walk_in(cells).any_occupied(shape.bounds(), shape, show_visible)) {
      return true;
    }
  }
  return false;
}

template <class Shape>
bool LayeredView::hits(const Shape& shape, Use use) const {
  return any_obstacle(shape, use, [](const Aabb&) { return true; });
}

}  // namespace flyball
