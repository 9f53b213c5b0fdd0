// SPDX-License-Identifier: BSD-3-Clause
// tested-in: brick_view
#include "mask_window.h"

#include "flyball/runtime/assert.h"

#include "bits.h"
#include <algorithm>

namespace flyball {
namespace {

constexpr std::size_t bricks_in_chunk = 512;
constexpr std::size_t words_in_chunk = bricks_in_chunk / 64;

}  // namespace

void MaskWindow::span(const CellKey& first, const CellKey& last) {
  first_ = first;
  size_ = {last.x - first.x + 1, last.y - first.y + 1, last.z - first.z + 1};
  const auto chunks = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                      static_cast<std::size_t>(size_.z);
  FLYBALL_ASSERT(chunks < 65536, "chunks=%zu", chunks);
  if (chunks * words_in_chunk > touched_.size()) {
    masks_.resize(chunks * bricks_in_chunk);
    touched_.resize(chunks * words_in_chunk);
  }
}

WindowChunks MaskWindow::chunks() const {
  return {{32 * first_.x, 32 * first_.y, 32 * first_.z},
          {32 * size_.x, 32 * size_.y, 32 * size_.z},
          {1, size_.x, size_.x * size_.y}};
}

std::size_t MaskWindow::place(const CellKey& chunk) const {
  const auto is_inside = [](int at, int size) {
    return static_cast<unsigned>(at) < static_cast<unsigned>(size);
  };
  FLYBALL_ASSERT(is_inside(chunk.x - first_.x, size_.x) && is_inside(chunk.y - first_.y, size_.y) &&
                     is_inside(chunk.z - first_.z, size_.z),
                 "chunk %d %d %d", chunk.x, chunk.y, chunk.z);
  return bricks_in_chunk *
         static_cast<std::size_t>(((chunk.z - first_.z) * size_.y + chunk.y - first_.y) * size_.x +
                                  chunk.x - first_.x);
}

void MaskWindow::free_block(std::size_t place, std::size_t bricks) {
  constexpr std::uint64_t all = ~std::uint64_t{0};
  for (std::size_t brick = place; brick < place + bricks; ++brick) {
    masks_[brick].free = all;
  }
  const std::size_t word = place >> 6U;
  if (bricks < 64) {
    touched_[word] |= (all >> (64 - bricks)) << (place & 63U);
  } else {
    std::fill_n(&touched_[word], bricks / 64, all);
  }
}

std::size_t MaskWindow::collect(std::vector<BrickMasks>& bricks) {
  std::size_t cells = 0;
  for (int z = 0; z < size_.z; ++z) {
    for (int y = 0; y < size_.y; ++y) {
      for (int x = 0; x < size_.x; ++x) {
        cells += collect_chunk({first_.x + x, first_.y + y, first_.z + z}, bricks);
      }
    }
  }
  return cells;
}

std::size_t MaskWindow::collect_chunk(const CellKey& chunk, std::vector<BrickMasks>& bricks) {
  const std::size_t first = place(chunk);
  std::size_t cells = 0;
  for (std::size_t word = 0; word < words_in_chunk; ++word) {
    std::uint64_t& touched = touched_[first / 64 + word];
    for (std::uint64_t left = touched; left != 0; left &= left - 1) {
      const std::size_t number = 64 * word + lowest_bit(left);
      Masks& masks = masks_[first + number];
      const std::uint64_t free = masks.free & ~masks.hit;
      bricks.push_back({brick_in(chunk, number), free, masks.hit});
      cells += count_bits(free | masks.hit);
      masks = Masks{};
    }
    touched = 0;
  }
  return cells;
}

}  // namespace flyball
