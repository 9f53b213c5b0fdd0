// SPDX-License-Identifier: BSD-3-Clause
// tested-in: brick_view
#include "mark_window.h"

#include "flyball/runtime/assert.h"

#include "bits.h"

namespace flyball {
namespace {

/// The lowest bits of eight bytes as one byte.
std::uint64_t gathered(std::uint64_t bytes) {
  constexpr std::uint64_t lowest = 0x0101010101010101;
  constexpr std::uint64_t to_top_byte = 0x0102040810204080;
  return (bytes & lowest) * to_top_byte >> 56U;
}

}  // namespace

void MarkWindow::span(const CellKey& first, const CellKey& last) {
  const std::array<int, 3> low{first.x, first.y, first.z};
  const std::array<int, 3> high{last.x, last.y, last.z};
  unsigned shift = 6;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first_brick_[axis] = low[axis] >> 2;
    bricks_[axis] = (high[axis] >> 2) - first_brick_[axis] + 1;
    FLYBALL_ASSERT(bricks_[axis] <= 257, "bricks=%d", bricks_[axis]);
    brick_shift_[axis] = shift;
    const unsigned first_bit = shift;
    while (1 << (shift - first_bit) < bricks_[axis]) {
      ++shift;
    }
    bits_[axis] = 3U << 2 * axis | ((1U << (shift - first_bit)) - 1U) << first_bit;
  }
  const std::size_t lines = std::size_t{1} << (shift - 6);
  if (lines > lines_.size()) {
    lines_.resize(lines, Line{});
  }
}

std::size_t MarkWindow::collect(std::vector<BrickMasks>& bricks) {
  std::size_t cells = 0;
  const auto last = [&](std::size_t axis) { return first_brick_[axis] + bricks_[axis] - 1; };
  for (int z = first_brick_[2] >> 3; z <= last(2) >> 3; ++z) {
    for (int y = first_brick_[1] >> 3; y <= last(1) >> 3; ++y) {
      for (int x = first_brick_[0] >> 3; x <= last(0) >> 3; ++x) {
        cells += collect_chunk({x, y, z}, bricks);
      }
    }
  }
  return cells;
}

std::size_t MarkWindow::collect_chunk(const CellKey& chunk, std::vector<BrickMasks>& bricks) {
  const std::array<int, 3> offset{8 * chunk.x - first_brick_[0], 8 * chunk.y - first_brick_[1],
                                  8 * chunk.z - first_brick_[2]};
  std::size_t cells = 0;
  for (unsigned number = 0; number < 512; ++number) {
    const int x = offset[0] + brick_offset(number, 0);
    const int y = offset[1] + brick_offset(number, 1);
    const int z = offset[2] + brick_offset(number, 2);
    const auto is_inside = [this](int at, std::size_t axis) {
      return static_cast<unsigned>(at) < static_cast<unsigned>(bricks_[axis]);
    };
    if (!is_inside(x, 0) || !is_inside(y, 1) || !is_inside(z, 2)) {
      continue;
    }
    Line& line =
        lines_[static_cast<std::size_t>(x) | static_cast<std::size_t>(y) << (brick_shift_[1] - 6) |
               static_cast<std::size_t>(z) << (brick_shift_[2] - 6)];
    BrickMasks masks = masks_of(line);
    if ((masks.free | masks.hit) != 0) {
      line = Line{};
      masks.brick = {first_brick_[0] + x, first_brick_[1] + y, first_brick_[2] + z};
      cells += count_bits(masks.free | masks.hit);
      bricks.push_back(masks);
    }
  }
  return cells;
}

BrickMasks MarkWindow::masks_of(const Line& line) {
  std::uint64_t any = 0;
  for (const std::uint64_t row : line.rows) {
    any |= row;
  }
  BrickMasks masks;
  if (any == 0) {
    return masks;
  }
  for (unsigned row = 0; row < 8; ++row) {
    masks.free |= gathered(line.rows[row]) << 8 * row;
    masks.hit |= gathered(line.rows[row] >> 1U) << 8 * row;
  }
  masks.free &= ~masks.hit;
  return masks;
}

}  // namespace flyball
