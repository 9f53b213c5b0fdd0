// SPDX-License-Identifier: BSD-3-Clause
#include "clear_cells.h"

#include <algorithm>
#include <tuple>

namespace flyball {
namespace {

std::uint64_t number_of(const CellKey& brick) {
  const auto bits = [](int key) { return static_cast<std::uint64_t>(key) & 0xffffU; };
  return bits(brick.x) << 32U | bits(brick.y) << 16U | bits(brick.z);
}

/// One of the 27 around and at a brick.
CellKey neighbour(const CellKey& at, int i) {
  return {at.x + i % 3 - 1, at.y + i / 3 % 3 - 1, at.z + i / 9 - 1};
}

}  // namespace

void ClearCells::add(const std::vector<BrickMasks>& changes) {
  for (const BrickMasks& change : changes) {
    take(change);
  }
  update_changed();
}

void ClearCells::declare(const Vec3& centre_W, const Cylinder& space) {
  const Vec3 half{space.radius_m, space.radius_m, space.half_height_m};
  const Lattice& lattice = cells_.lattice();
  if (!lattice.contains(centre_W - half) || !lattice.contains(centre_W + half)) {
    return;  // no cell there can be known
  }
  const CellKey first = lattice.cell(centre_W - half);
  const CellKey last = lattice.cell(centre_W + half);
  const auto is_inside = [&](const CellKey& cell) {
    const Aabb box = lattice.cube(cell, 0);
    const Vec3 nearest_W = box.nearest(centre_W);
    return (nearest_W - centre_W).head<2>().norm() < space.radius_m;
  };
  const auto declare_row = [&](int y, int z) {
    for (int x = first.x; x <= last.x; ++x) {
      if (is_inside({x, y, z})) {
        declare({x, y, z});
      }
    }
  };
  for (int z = first.z; z <= last.z; ++z) {
    for (int y = first.y; y <= last.y; ++y) {
      declare_row(y, z);
    }
  }
  update_changed();
}

void ClearCells::declare(const CellKey& cell) {
  const CellKey at = cell.above(brick_level);
  const std::uint64_t bit = std::uint64_t{1} << bit_in_brick(cell);
  Known& brick = bricks_[number_of(at)];
  if ((brick.declared & bit) == 0) {
    brick.declared |= bit;
    changes_around(at);
  }
}

void ClearCells::changes_around(const CellKey& brick) {
  for (int i = 0; i < 27; ++i) {
    changed_.push_back(neighbour(brick, i));
  }
}

void ClearCells::update_changed() {
  const auto order = [](const CellKey& a) { return std::tie(a.x, a.y, a.z); };
  std::sort(changed_.begin(), changed_.end(),
            [&](const CellKey& a, const CellKey& b) { return order(a) < order(b); });
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  for (const CellKey& at : changed_) {
    update(at);
  }
  changed_.clear();
  cells_.show(shown_);
  shown_.clear();
}

void ClearCells::take(const BrickMasks& change) {
  Known& brick = bricks_[number_of(change.brick)];
  const std::uint64_t seen = change.free | change.hit;
  const bool knows_more = (seen & ~brick.known) != 0;
  const bool is_hit_anew = (change.hit & ~brick.ever_hit) != 0;
  brick.known |= seen;
  brick.ever_hit |= change.hit;
  if (knows_more || is_hit_anew) {
    changes_around(change.brick);
  }
}

void ClearCells::update(const CellKey& at) {
  const auto found = bricks_.find(number_of(at));
  if (found == bricks_.end()) {
    return;
  }
  Known& brick = found->second;
  const std::uint64_t clear = surrounded(known_around(at)) & brick.known & ~brick.ever_hit;
  if (clear != brick.clear) {
    brick.clear = clear;
    shown_.push_back({at, {0, ~clear}});
  }
}

ClearCells::Rows ClearCells::known_around(const CellKey& at) const {
  Rows rows{};
  for (int i = 0; i < 27; ++i) {
    const CellKey step = neighbour({0, 0, 0}, i);
    const auto found = bricks_.find(number_of(neighbour(at, i)));
    if (found == bricks_.end()) {
      continue;
    }
    const std::uint64_t known = found->second.known | found->second.declared;
    for (int z = std::max(-1, 4 * step.z); z < std::min(5, 4 * step.z + 4); ++z) {
      for (int y = std::max(-1, 4 * step.y); y < std::min(5, 4 * step.y + 4); ++y) {
        const auto first = static_cast<unsigned>((z & 3) << 4 | (y & 3) << 2);
        const auto row = static_cast<unsigned>(known >> first & 0xfU);
        const unsigned in_place = step.x < 0 ? row >> 3U : row << (4 * step.x + 1);
        rows[z + 1][y + 1] |= in_place & 0x3fU;
      }
    }
  }
  return rows;
}

std::uint64_t ClearCells::surrounded(const Rows& known) {
  std::uint64_t cells = 0;
  for (unsigned z = 0; z < 4; ++z) {
    for (unsigned y = 0; y < 4; ++y) {
      unsigned row = 0x3fU;
      for (unsigned i = 0; i < 9; ++i) {
        row &= known[z + i / 3][y + i % 3];
      }
      cells |= std::uint64_t{row & row >> 1U & row >> 2U & 0xfU} << (16 * z + 4 * y);
    }
  }
  return cells;
}

void ClearCells::add(const BrickCells& map) {
  std::vector<BrickMasks> cells;
  for (const Chunk* chunk : map.chunks()) {
    for (std::size_t brick = 0; brick < Chunk::brick_count; ++brick) {
      const CellMasks& states = chunk->masks[brick];
      if (~states.unknown != 0) {
        cells.push_back(
            {brick_in(chunk->key, brick), ~(states.unknown | states.occupied), states.occupied});
      }
    }
  }
  add(cells);
}

std::size_t ClearCells::bytes() const {
  return cells_.bytes() + bricks_.size() * (sizeof(Known) + 2 * sizeof(std::uint64_t));
}

}  // namespace flyball
