// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Walks down a brick map, only where a shape is, and shows what the map says there. At a coarse
/// level an occupied cell is shown with its full cube; unknown space is always shown cell by finest
/// cell, so that what was seen of a coarse cell stays seen.

#include "brick_cells.h"
#include "scans/scan_masks.h"
#include "visual/overlap.h"
#include <array>

namespace flyball {

class BrickWalk {
 public:
  /// The map outlives the walk. @param level  Of the cells that block: 0..5.
  BrickWalk(const BrickCells& map, int level) : map_{map}, lattice_{map.lattice()}, level_{level} {}

  /// Shows each occupied cube, cut to the shape's bounds, that overlaps the shape. Ends when
  /// `show(part)` returns true, and says whether it did.
  template <class Shape, class Show>
  [[nodiscard]] bool any_occupied(const Shape& shape, Show&& show) const {
    return any_occupied(shape.bounds(), shape, show);
  }
  /// The same, cut to `region`.
  template <class Shape, class Show>
  [[nodiscard]] bool any_occupied(const Aabb& region, const Shape& shape, Show&& show) const {
    return any_chunk(
        scope(region, shape), [&](const CellKey& at, const Chunk* chunk, const auto& scope) {
          return chunk != nullptr && occupied_below({*chunk, at, 0, chunk_level}, scope, show);
        });
  }

  /// The same for cubes of which nothing is known.
  template <class Shape, class Show>
  [[nodiscard]] bool any_unknown(const Shape& shape, Show&& show) const {
    return any_unknown(shape.bounds(), shape, show);
  }
  template <class Shape, class Show>
  [[nodiscard]] bool any_unknown(const Aabb& region, const Shape& shape, Show&& show) const {
    if (!lattice_.contains(region.min) || !lattice_.contains(region.max)) {
      return show(region);
    }
    return any_chunk(
        scope(region, shape), [&](const CellKey& at, const Chunk* chunk, const auto& scope) {
          return chunk == nullptr ? show_part(lattice_.cube(at, chunk_level), scope, show)
                                  : unknown_below({*chunk, at, 0, chunk_level}, scope, show);
        });
  }

 private:
  using Keys = std::array<int, 3>;

  /// Where the walk is: a block of a chunk, its key at its level, its first brick.
  struct Block {
    const Chunk& chunk;
    CellKey key{};
    std::size_t brick{};
    int level{};

    [[nodiscard]] BlockSummary summary() const { return chunk.block(level, brick); }
    [[nodiscard]] Block part(unsigned octant) const {
      const auto bit = [&](unsigned axis) { return static_cast<int>(octant >> axis & 1U); };
      const std::size_t bricks = std::size_t{1}
                                 << 3 * static_cast<unsigned>(level - 1 - brick_level);
      return {chunk,
              {2 * key.x + bit(0), 2 * key.y + bit(1), 2 * key.z + bit(2)},
              brick + octant * bricks,
              level - 1};
    }
  };

  template <class Shape>
  struct Scope {
    const Shape& shape;
    Aabb region{};
    Keys first{};  ///< Finest cells that the region overlaps.
    Keys last{};
    Keys focus{};
  };

  template <class Shape>
  [[nodiscard]] Scope<Shape> scope(const Aabb& region, const Shape& shape) const {
    const double edge = lattice_.edge_m();
    const auto keys = [&](const Vec3& p) {
      const auto key = [&](double x) {
        return std::clamp(lattice_.key(std::clamp(x, -edge, edge)), 0, Lattice::keys - 1);
      };
      return Keys{key(p.x()), key(p.y()), key(p.z())};
    };
    const Vec3 margin = Vec3::Constant(touch_m);
    return {shape, region, keys(region.min + margin), keys(region.max - margin),
            keys(shape.focus())};
  }

  template <class Shape, class Visit>
  [[nodiscard]] bool any_chunk(const Scope<Shape>& scope, Visit&& visit) const {
    const auto chunk = [](int key) { return key >> chunk_level; };
    const Keys first{chunk(scope.first[0]), chunk(scope.first[1]), chunk(scope.first[2])};
    const Keys last{chunk(scope.last[0]), chunk(scope.last[1]), chunk(scope.last[2])};
    return first[0] <= last[0] && first[1] <= last[1] && first[2] <= last[2] &&
           any_chunk_between(first, last, scope, visit);
  }

  /// Halves the box of chunks where it is longest, so that a long thin shape meets few of them.
  template <class Shape, class Visit>
  [[nodiscard]] bool any_chunk_between(const Keys& first,
                                       const Keys& last,
                                       const Scope<Shape>& scope,
                                       Visit& visit) const {
    const CellKey low{first[0], first[1], first[2]};
    // Not `first == last`, which is a call.
    if (first[0] == last[0] && first[1] == last[1] && first[2] == last[2]) {
      return visit(low, map_.find(low), scope);
    }
    const Aabb box{lattice_.cube(low, chunk_level).min,
                   lattice_.cube({last[0], last[1], last[2]}, chunk_level).max};
    if (!scope.shape.overlaps(box)) {
      return false;
    }
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      axis = last[i] - first[i] > last[axis] - first[axis] ? i : axis;
    }
    Keys middle_last = last;
    Keys middle_first = first;
    middle_last[axis] = (first[axis] + last[axis]) / 2;
    middle_first[axis] = middle_last[axis] + 1;
    if (scope.focus[axis] >> chunk_level < middle_first[axis]) {
      return any_chunk_between(first, middle_last, scope, visit) ||
             any_chunk_between(middle_first, last, scope, visit);
    }
    return any_chunk_between(middle_first, last, scope, visit) ||
           any_chunk_between(first, middle_last, scope, visit);
  }

  template <class Shape, class Show>
  [[nodiscard]] static bool show_part(const Aabb& cube, const Scope<Shape>& scope, Show& show) {
    const Aabb part = intersection(cube, scope.region);
    return scope.shape.overlaps(part) && show(part);
  }

  /// Visits the eighths that overlap the shape, near ones first.
  template <class Shape, class Visit>
  [[nodiscard]] bool any_part(const Block& block, const Scope<Shape>& scope, Visit&& visit) const {
    const int half = 1 << (block.level - 1);
    const auto is_upper = [&](int key, int block_key) {
      return key >= (block_key << block.level) + half ? 1U : 0U;
    };
    const auto octant_of = [&](const Keys& keys) {
      return is_upper(keys[0], block.key.x) | is_upper(keys[1], block.key.y) << 1U |
             is_upper(keys[2], block.key.z) << 2U;
    };
    const unsigned nearest = octant_of(scope.focus);
    const unsigned low = octant_of(scope.first);
    const unsigned high = octant_of(scope.last);
    for (unsigned n = 0; n < 8; ++n) {
      const unsigned octant = n ^ nearest;
      if ((octant & low) == low && (octant & ~high) == 0 && visit(block.part(octant))) {
        return true;
      }
    }
    return false;
  }

  template <class Shape, class Show>
  [[nodiscard]] bool occupied_below(const Block& block,
                                    const Scope<Shape>& scope,
                                    Show& show) const {
    if (!Chunk::any(block.chunk.has_occupied, block.level, block.brick)) {
      return false;
    }
    const Aabb cube = lattice_.cube(block.key, block.level);
    if (block.level == level_) {
      return show_part(cube, scope, show);
    }
    if (!scope.shape.overlaps(cube)) {
      return false;
    }
    if (block.level == brick_level) {
      return any_cell(block, block.chunk.masks[block.brick].occupied, level_, scope, show);
    }
    return any_part(block, scope,
                    [&](const Block& part) { return occupied_below(part, scope, show); });
  }

  template <class Shape, class Show>
  [[nodiscard]] bool unknown_below(const Block& block,
                                   const Scope<Shape>& scope,
                                   Show& show) const {
    const BlockSummary summary = block.summary();
    if (!summary.has_unknown) {
      return false;
    }
    const Aabb cube = lattice_.cube(block.key, block.level);
    if (!summary.has_known) {
      return show_part(cube, scope, show);
    }
    if (!scope.shape.overlaps(cube)) {
      return false;
    }
    if (block.level == brick_level) {
      return any_cell(block, block.chunk.masks[block.brick].unknown, 0, scope, show);
    }
    return any_part(block, scope,
                    [&](const Block& part) { return unknown_below(part, scope, show); });
  }

  /// The cells of a brick that have a bit, as cubes of level 0 or 1.
  template <class Shape, class Show>
  [[nodiscard]] bool any_cell(const Block& brick,
                              std::uint64_t cells,
                              int level,
                              const Scope<Shape>& scope,
                              Show& show) const {
    const int edge = 1 << level;
    const std::uint64_t one_cube = level == 0 ? 1 : 0x330033;
    const Keys base{4 * brick.key.x, 4 * brick.key.y, 4 * brick.key.z};
    Keys low{};
    Keys high{};
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::max(scope.first[i] - base[i], 0) & ~(edge - 1);
      high[i] = std::min(scope.last[i] - base[i], 3);
    }
    const auto any_in_row = [&](int y, int z) {
      for (int x = low[0]; x <= high[0]; x += edge) {
        const CellKey cell{base[0] + x, base[1] + y, base[2] + z};
        if ((cells >> bit_in_brick(cell) & one_cube) != 0 &&
            show_part(lattice_.cube(cell.above(level), level), scope, show)) {
          return true;
        }
      }
      return false;
    };
    for (int z = low[2]; z <= high[2]; z += edge) {
      for (int y = low[1]; y <= high[1]; y += edge) {
        if (any_in_row(y, z)) {
          return true;
        }
      }
    }
    return false;
  }

  const BrickCells& map_;
  const Lattice& lattice_;
  int level_;
};

}  // namespace flyball
