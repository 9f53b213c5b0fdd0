// SPDX-License-Identifier: BSD-3-Clause
#include "octomap_view.h"

#include "octree_walk.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr double column_m = 0.8;        // of obstacle density, fixed by its definition
constexpr double column_hair_m = 1e-3;  // a cell that only grazes a column does not fill it
constexpr double smallest_piece_m = 0.02;

/// Whether the upright cylinder `outer` contains the disc around (x, y).
bool holds_disc(const Vec3& centre_W, const Cylinder& outer, const Vec3& p_W, double radius_m) {
  const double room_m = outer.radius_m - radius_m + touch_m;
  return room_m >= 0.0 && (p_W - centre_W).head<2>().squaredNorm() <= room_m * room_m;
}

bool holds_heights(const Vec3& centre_W, const Cylinder& outer, double low_m, double high_m) {
  return low_m >= centre_W.z() - outer.half_height_m - touch_m &&
         high_m <= centre_W.z() + outer.half_height_m + touch_m;
}

/// Whether the disc of `outer` contains the box's rectangle: its farthest corner decides.
bool holds_rectangle(const Vec3& centre_W, const Cylinder& outer, const Aabb& box) {
  const Vec3 far = (box.min - centre_W).cwiseAbs().cwiseMax((box.max - centre_W).cwiseAbs());
  const double reach_m = outer.radius_m + touch_m;
  return far.head<2>().squaredNorm() <= reach_m * reach_m;
}

/// The two halves of a box, cut across its longest edge.
std::array<Aabb, 2> halves(const Aabb& box) {
  Eigen::Index axis = 0;
  (box.max - box.min).maxCoeff(&axis);
  std::array<Aabb, 2> result{box, box};
  result[0].max[axis] = result[1].min[axis] = 0.5 * (box.min[axis] + box.max[axis]);
  return result;
}

bool is_free(const octomap::OcTree& tree, const octomap::OcTreeKey& key) {
  const octomap::OcTreeNode* node = tree.search(key);
  return node != nullptr && !tree.isNodeOccupied(node);
}

Aabb everywhere() {
  const Vec3 far = Vec3::Constant(std::numeric_limits<double>::max());
  return {-far, far};
}

}  // namespace

/// A square block of density columns, and the disc and band that count.
struct OctomapView::Columns {
  long long first_x;
  long long first_y;
  long long count;  ///< Along each edge; a power of two.
  const Vec3& p_W;
  double radius_m;
  double half_band_m;

  [[nodiscard]] Aabb box() const {
    const Vec3 low{static_cast<double>(first_x) * column_m, static_cast<double>(first_y) * column_m,
                   p_W.z() - half_band_m};
    const double edge_m = static_cast<double>(count) * column_m;
    return {low, {low.x() + edge_m, low.y() + edge_m, p_W.z() + half_band_m}};
  }
  [[nodiscard]] Aabb inside() const {
    const Vec3 hair{column_hair_m, column_hair_m, 0.0};
    const Aabb whole = box();
    return {whole.min + hair, whole.max - hair};
  }
  [[nodiscard]] bool centre_counts() const {
    const Aabb whole = box();
    return (0.5 * (whole.min + whole.max) - p_W).head<2>().norm() <= radius_m;
  }
  [[nodiscard]] Columns quarter(int i) const {
    const long long half = count / 2;
    return {first_x + (i % 2) * half, first_y + (i / 2) * half, half, p_W, radius_m, half_band_m};
  }
};

void OctomapView::activate(const Layer& layer) {
  const auto is_it = [&](const Layer& other) { return other.tree == layer.tree; };
  layers_.erase(std::remove_if(layers_.begin(), layers_.end(), is_it), layers_.end());
  layers_.insert(layers_.begin(), layer);
}

void OctomapView::declare_clear(const Vec3& centre_W, const Cylinder& space) {
  for (const Clear& clear : clear_) {
    if (holds_disc(clear.centre_W, clear.space, centre_W, space.radius_m) &&
        holds_heights(clear.centre_W, clear.space, centre_W.z() - space.half_height_m,
                      centre_W.z() + space.half_height_m)) {
      return;
    }
  }
  if (clear_.size() == max_clear) {
    // Where the body has been is declared again and again; take-off and landing places, which are
    // wider, must survive that.
    clear_.erase(std::min_element(clear_.begin(), clear_.end(), [](const Clear& a, const Clear& b) {
      return a.space.radius_m < b.space.radius_m;
    }));
  }
  clear_.push_back({centre_W, space});
}

double OctomapView::resolution_m() const {
  return layers_.empty() ? initial_resolution_m : layers_.front().tree->getResolution();
}

CellState OctomapView::state(const Vec3& p_W) const {
  if (!p_W.allFinite()) {
    return CellState::unknown;
  }
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    const octomap::OcTree& tree = *layers_[layer].tree;
    octomap::OcTreeKey key;
    if (!tree.coordToKeyChecked(p_W.x(), p_W.y(), p_W.z(), key)) {
      continue;
    }
    const octomap::OcTreeNode* node = tree.search(key);
    if (node == nullptr) {
      continue;
    }
    if (tree.isNodeOccupied(node)) {
      if (!is_vague(layer, Use::move)) {
        return CellState::occupied;
      }
      continue;
    }
    const octomap::OcTree& trusted = known(layer, Use::move);
    if (&trusted == &tree || is_free(trusted, key)) {
      return CellState::free;
    }
  }
  const auto contains = [&](const Clear& clear) {
    return holds_disc(clear.centre_W, clear.space, p_W, 0.0) &&
           holds_heights(clear.centre_W, clear.space, p_W.z(), p_W.z());
  };
  return std::any_of(clear_.begin(), clear_.end(), contains) ? CellState::free : CellState::unknown;
}

CellState OctomapView::body_state(const Vec3& p_WB, const Cylinder& body) const {
  if (!p_WB.allFinite()) {
    return CellState::unknown;
  }
  const BodyShape shape{p_WB, body};
  if (hits(shape, Use::move)) {
    return CellState::occupied;
  }
  const auto is_open = [&](const Aabb& part) { return !is_cleared(part, shape); };
  return any_gap({layers_.size(), Use::move}, shape.bounds(), shape, is_open) ? CellState::unknown
                                                                              : CellState::free;
}

bool OctomapView::has_occupied(const Aabb& box) const {
  return hits(BoxShape{box}, Use::move);
}

bool OctomapView::segment_hits(const Vec3& from, const Vec3& to, const Cylinder& body) const {
  return !from.allFinite() || !to.allFinite() || hits(SweepShape{from, to, body}, Use::move);
}

double OctomapView::obstacle_density(const Vec3& p_W, double radius_m, double half_band_m) const {
  const auto first = [&](double x) {
    return static_cast<long long>(std::floor((x - radius_m) / column_m));
  };
  long long edge = 1;
  while (static_cast<double>(edge) * column_m < 2.0 * radius_m + 2.0 * column_m) {
    edge *= 2;
  }
  const Columns all{first(p_W.x()), first(p_W.y()), edge, p_W, radius_m, half_band_m};
  int columns = 0;
  for (long long i = 0; i < edge * edge; ++i) {
    const Columns one{all.first_x + i % edge, all.first_y + i / edge, 1, p_W, radius_m, 0.0};
    columns += one.centre_counts() ? 1 : 0;
  }
  return columns == 0 ? 0.0 : static_cast<double>(occupied_columns(all)) / columns;
}

int OctomapView::occupied_columns(const Columns& block) const {
  if (!hits(BoxShape{block.inside()}, Use::look)) {
    return 0;
  }
  if (block.count == 1) {
    return block.centre_counts() ? 1 : 0;
  }
  int sum = 0;
  for (int i = 0; i < 4; ++i) {
    sum += occupied_columns(block.quarter(i));
  }
  return sum;
}

double OctomapView::nearest_obstacle_m(const Vec3& p_W, double limit_m, double half_band_m) const {
  NearestShape shape{p_W, limit_m, half_band_m};
  (void)any_obstacle(shape, Use::look, [&](const Aabb& part) {
    shape.shrink_to(part);
    return false;
  });
  return shape.nearest_m();
}

void OctomapView::for_each_occupied(const std::function<void(const Aabb& cube)>& show) const {
  const BoxShape space{everywhere()};
  const auto show_if_it_counts = [&](std::size_t layer, const Aabb& cube) {
    if (any_gap({layer, Use::look}, cube, BoxShape{cube}, [](const Aabb&) { return true; })) {
      show(cube);
    }
    return false;
  };
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    const auto visit = [&](const Aabb& cube) { return show_if_it_counts(layer, cube); };
    (void)OctreeWalk{*layers_[layer].tree}.any_occupied(space.bounds(), space, visit);
  }
}

bool OctomapView::is_vague(std::size_t layer, Use use) const {
  constexpr double same = 1.001;
  return use == Use::move &&
         layers_[layer].tree->getResolution() > same * layers_.front().tree->getResolution();
}

const octomap::OcTree& OctomapView::known(std::size_t layer, Use use) const {
  const Layer& of = layers_[layer];
  return is_vague(layer, use) && of.trusted_by_finer != nullptr ? *of.trusted_by_finer : *of.tree;
}

template <class Shape, class Show>
bool OctomapView::any_gap(Layers layers,
                          const Aabb& region,
                          const Shape& shape,
                          Show&& show) const {
  return any_gap_from(0, layers, region, shape, show);
}

template <class Shape, class Show>
bool OctomapView::any_gap_from(
    std::size_t layer, Layers layers, const Aabb& region, const Shape& shape, Show& show) const {
  if (layer == layers.count) {
    return show(region);
  }
  const octomap::OcTree& tree = known(layer, layers.use);
  const bool occupied_is_known = &tree == layers_[layer].tree && !is_vague(layer, layers.use);
  const OctreeWalk walk{tree};
  const auto deeper = [&](const Aabb& part) {
    return any_gap_from(layer + 1, layers, part, shape, show);
  };
  return walk.any_unknown(region, shape, deeper) ||
         (!occupied_is_known && walk.any_occupied(region, shape, deeper));
}

template <class Shape, class Show>
bool OctomapView::any_obstacle(const Shape& shape, Use use, Show&& show) const {
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    const auto show_visible = [&](const Aabb& part) {
      return any_gap({layer, use}, part, shape, show);
    };
    if (!is_vague(layer, use) &&
        OctreeWalk{*layers_[layer].tree}.any_occupied(shape.bounds(), shape, show_visible)) {
      return true;
    }
  }
  return false;
}

template <class Shape>
bool OctomapView::hits(const Shape& shape, Use use) const {
  return any_obstacle(shape, use, [](const Aabb&) { return true; });
}

bool OctomapView::is_cleared(const Aabb& part, const BodyShape& body) const {
  if (clear_.empty()) {
    return false;
  }
  if (!body.overlaps(part) || is_in_clear(part, body)) {
    return true;
  }
  if ((part.max - part.min).maxCoeff() <= smallest_piece_m) {
    return false;
  }
  const auto pieces = halves(part);
  return is_cleared(pieces[0], body) && is_cleared(pieces[1], body);
}

bool OctomapView::is_in_clear(const Aabb& part, const BodyShape& body) const {
  return std::any_of(clear_.begin(), clear_.end(), [&](const Clear& clear) {
    return holds_heights(clear.centre_W, clear.space, part.min.z(), part.max.z()) &&
           (holds_disc(clear.centre_W, clear.space, body.focus(), body.body().radius_m) ||
            holds_rectangle(clear.centre_W, clear.space, part));
  });
}

}  // namespace flyball
