// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Random maps, and what they say by definition: the brute force that the view is held against.

#include "bricks/octree_copy.h"
#include "maps/layered_view.h"
#include "maps/octomap_tree.h"
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace flyball::kit {

struct Fill {
  double free;
  double occupied;
};

/// Blocks of a random state each, in a cube of 6.4 m around the origin; the rest is unknown.
inline std::unique_ptr<octomap::OcTree> random_tree(double resolution_m, Fill fill, unsigned seed) {
  auto tree = std::make_unique<octomap::OcTree>(resolution_m);
  std::mt19937 generator{seed};
  const int cells = static_cast<int>(std::lround(6.4 / resolution_m));
  const auto key = [&](int i) { return static_cast<octomap::key_type>(32768 - cells / 2 + i); };
  for (int i = 0; i < cells * cells * cells; ++i) {
    const double dice = 1e-3 * static_cast<double>(generator() % 1000);
    const octomap::OcTreeKey at{key(i % cells), key(i / cells % cells), key(i / cells / cells)};
    if (dice < fill.free + fill.occupied) {
      tree->setNodeValue(at, dice < fill.free ? -1.0F : 1.0F);
    }
  }
  return tree;
}

/// The map cell by cell, by definition: each cell of a lattice that all trees share.
class Reference {
 public:
  Reference(double cell_m, std::vector<const octomap::OcTree*> trees)
      : cell_m_{cell_m}, trees_{std::move(trees)} {}

  /// `moving`: an occupied cube of a tree coarser than the first does not count as known.
  [[nodiscard]] CellState at(const Vec3& p, bool moving = true) const {
    for (const auto* tree : trees_) {
      const auto* node = tree->search(p.x(), p.y(), p.z());
      if (node != nullptr && !tree->isNodeOccupied(node)) {
        return CellState::free;
      }
      if (node != nullptr &&
          (!moving || tree->getResolution() <= 1.001 * trees_.front()->getResolution())) {
        return CellState::occupied;
      }
    }
    return CellState::unknown;
  }

  /// Calls `visit(cube, state)` for every cell that the box overlaps.
  template <class Visit>
  void visit(const Aabb& box, Visit&& visit, bool moving = true) const {
    const auto first = [&](int axis) { return std::floor(box.min[axis] / cell_m_); };
    for (double x = first(0); x * cell_m_ < box.max.x(); ++x) {
      for (double y = first(1); y * cell_m_ < box.max.y(); ++y) {
        for (double z = first(2); z * cell_m_ < box.max.z(); ++z) {
          const Vec3 low = cell_m_ * Vec3{x, y, z};
          visit(Aabb{low, low + Vec3::Constant(cell_m_)},
                at(low + Vec3::Constant(0.5 * cell_m_), moving));
        }
      }
    }
  }

  [[nodiscard]] CellState body_state(const Vec3& p, const Cylinder& space) const {
    const Vec3 half{space.radius_m, space.radius_m, space.half_height_m};
    CellState worst = CellState::free;
    visit({p - half, p + half}, [&](const Aabb& cube, CellState state) {
      const Vec3 nearest = p.cwiseMax(cube.min).cwiseMin(cube.max) - p;
      if (nearest.head<2>().norm() < space.radius_m - 1e-9 &&
          std::abs(nearest.z()) < space.half_height_m - 1e-9) {
        worst = std::max(worst, state);
      }
    });
    return worst;
  }

 private:
  double cell_m_;
  std::vector<const octomap::OcTree*> trees_;
};

/// Trees as a view looks at them.
class TreesInView {
 public:
  LayeredView view{};

  void activate(const octomap::OcTree& tree) {
    auto cells = to_bricks(tree);
    maps_.push_back(std::make_unique<BrickMap>(std::move(cells.value())));
    view.activate(maps_.back()->cells());
  }

 private:
  std::vector<std::unique_ptr<BrickMap>> maps_{};
};

/// A map of some random trees with its reference.
struct Rig {
  std::vector<std::unique_ptr<octomap::OcTree>> trees;  ///< The active one first.
  TreesInView maps{};
  const LayeredView& view{maps.view};
  std::optional<Reference> reference;

  Rig(const std::vector<double>& resolutions_m, Fill fill) {
    std::vector<const octomap::OcTree*> order;
    for (const double resolution_m : resolutions_m) {
      trees.push_back(random_tree(resolution_m, fill, 7));
      order.push_back(trees.back().get());
    }
    for (auto tree = order.rbegin(); tree != order.rend(); ++tree) {
      maps.activate(**tree);
    }
    reference.emplace(*std::min_element(resolutions_m.begin(), resolutions_m.end()), order);
  }
};

inline const std::vector<std::vector<double>> stacks{
    {0.2}, {0.2, 0.8}, {0.8, 0.2}, {0.4, 0.8, 0.2}};
inline constexpr Fill dense{0.90, 0.01};
inline constexpr Fill sparse{0.40, 0.02};

inline Vec3 random_point(std::mt19937& generator, double half_m) {
  std::uniform_real_distribution<double> coordinate{-half_m, half_m};
  const double x = coordinate(generator);
  const double y = coordinate(generator);
  return {x, y, coordinate(generator)};
}

}  // namespace flyball::kit
