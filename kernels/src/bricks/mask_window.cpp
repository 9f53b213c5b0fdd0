// SPDX-License-Identifier: BSD-3-Clause
#include "mask_window.h"

#include "flyball/runtime/assert.h"

#include <bitset>

namespace flyball {
namespace {

std::size_t count(std::uint64_t mask) {
  return std::bitset<64>{mask}.count();
}

/// Takes the lowest bit out, and says which one it was.
std::size_t pop_lowest(std::uint64_t& bits) {
  const std::uint64_t lowest = bits & (~bits + 1);
  bits &= ~lowest;
  return count(lowest - 1);
}

/// Appends the masks of one chunk and wipes them.
std::size_t collect_chunk(ChunkMasks& masks,
                          const CellKey& chunk,
                          std::vector<BrickMasks>& bricks) {
  std::size_t cells = 0;
  for (std::size_t word = 0; word < masks.touched.size(); ++word) {
    for (std::uint64_t left = masks.touched[word]; left != 0;) {
      const std::size_t number = 64 * word + pop_lowest(left);
      const std::uint64_t hit = masks.hit[number];
      const std::uint64_t free = masks.free[number] & ~hit;
      bricks.push_back(
          {{8 * chunk.x + brick_offset(number, 0), 8 * chunk.y + brick_offset(number, 1),
            8 * chunk.z + brick_offset(number, 2)},
           free,
           hit});
      cells += count(free | hit);
      masks.free[number] = 0;
      masks.hit[number] = 0;
    }
    masks.touched[word] = 0;
  }
  return cells;
}

}  // namespace

void MaskWindow::span(const CellKey& first, const CellKey& last) {
  first_ = first;
  size_ = {last.x - first.x + 1, last.y - first.y + 1, last.z - first.z + 1};
  const std::size_t needed = index(last) + 1;
  if (needed > chunks_.size()) {
    chunks_.resize(needed);
  }
}

ChunkMasks& MaskWindow::at(const CellKey& chunk) {
  FLYBALL_ASSERT(contains(chunk), "chunk %d %d %d", chunk.x, chunk.y, chunk.z);
  return chunks_[index(chunk)];
}

bool MaskWindow::contains(const CellKey& chunk) const {
  const auto is_inside = [](int at, int size) {
    return static_cast<unsigned>(at) < static_cast<unsigned>(size);
  };
  return is_inside(chunk.x - first_.x, size_.x) && is_inside(chunk.y - first_.y, size_.y) &&
         is_inside(chunk.z - first_.z, size_.z);
}

std::size_t MaskWindow::collect(std::vector<BrickMasks>& bricks) {
  std::size_t cells = 0;
  for (int z = 0; z < size_.z; ++z) {
    for (int y = 0; y < size_.y; ++y) {
      for (int x = 0; x < size_.x; ++x) {
        const CellKey chunk{first_.x + x, first_.y + y, first_.z + z};
        cells += collect_chunk(chunks_[index(chunk)], chunk, bricks);
      }
    }
  }
  return cells;
}

std::size_t MaskWindow::index(const CellKey& chunk) const {
  return static_cast<std::size_t>(((chunk.z - first_.z) * size_.y + chunk.y - first_.y) * size_.x +
                                  chunk.x - first_.x);
}

}  // namespace flyball
