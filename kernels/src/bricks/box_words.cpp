// SPDX-License-Identifier: BSD-3-Clause
#include "box_words.h"

#include <algorithm>

namespace flyball {
namespace {

constexpr std::uint64_t all_cells = ~std::uint64_t{0};

/// The cells of a brick whose offset along an axis is at least 0, 1, 2, 3; at most is the rest.
constexpr std::array<std::array<std::uint64_t, 5>, 3> from_offset{
    {{all_cells, 0xeeeeeeeeeeeeeeee, 0xcccccccccccccccc, 0x8888888888888888, 0},
     {all_cells, 0xfff0fff0fff0fff0, 0xff00ff00ff00ff00, 0xf000f000f000f000, 0},
     {all_cells, 0xffffffffffff0000, 0xffffffff00000000, 0xffff000000000000, 0}}};

/// For each brick from that of cell `low` to that of `high`, which of its cells lie between them.
template <class AxisCells>
int cut(std::size_t axis, int low, int high, AxisCells& cells) {
  const int bricks = (high >> 2) - (low >> 2) + 1;
  const auto last = static_cast<std::size_t>(bricks - 1);
  cells.fill(all_cells);
  cells[0] &= from_offset[axis][static_cast<std::size_t>(low & 3)];
  cells[last] &= ~from_offset[axis][static_cast<std::size_t>((high & 3) + 1)];
  return bricks;
}

}  // namespace

BoxWords::BoxWords(const BrickMap& map, int level, const Aabb& region, double margin_m) {
  const Lattice& lattice = map.lattice();
  const Vec3 margin = Vec3::Constant(margin_m);
  if (!lattice.contains(region.min) || !lattice.contains(region.max) ||
      (region.max - region.min).maxCoeff() > (most_bricks - 1) * lattice.cell_m(brick_level)) {
    return;
  }
  const CellKey low = lattice.cell(region.min + margin);
  const CellKey high = lattice.cell(region.max - margin);
  fits_ = true;
  if (high.x < low.x || high.y < low.y || high.z < low.z) {
    return;  // thinner than the margin
  }
  std::array<AxisCells, 3> cells;
  first_ = low.above(brick_level);
  size_ = {cut(0, low.x, high.x, cells[0]), cut(1, low.y, high.y, cells[1]),
           cut(2, low.z, high.z, cells[2])};
  read(map, level, cells);
}

void BoxWords::read(const BrickMap& map, int level, const std::array<AxisCells, 3>& cells) {
  std::uint64_t any_occupied = 0;
  std::uint64_t any_unknown = 0;
  std::size_t at = 0;
  for (int z = 0; z < size_.z; ++z) {
    for (int y = 0; y < size_.y; ++y) {
      const std::uint64_t row =
          cells[2][static_cast<std::size_t>(z)] & cells[1][static_cast<std::size_t>(y)];
      for (int x = 0; x < size_.x; ++x, ++at) {
        const CellKey brick{first_.x + x, first_.y + y, first_.z + z};
        const Chunk& chunk = map.chunk_at(brick.above(chunk_level - brick_level));
        const std::size_t number = brick_number(brick);
        const std::uint64_t part = row & cells[0][static_cast<std::size_t>(x)];
        occupied_[at] = occupied_at(level, chunk, number) & part;
        unknown_[at] = chunk.masks[number].unknown & part;
        any_occupied |= occupied_[at];
        any_unknown |= unknown_[at];
      }
    }
  }
  has_occupied_ = any_occupied != 0;
  has_unknown_ = any_unknown != 0;
}

}  // namespace flyball
