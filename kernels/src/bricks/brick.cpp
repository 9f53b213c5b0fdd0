// SPDX-License-Identifier: BSD-3-Clause
#include "brick.h"

#include <cstring>

namespace flyball {
namespace {

/// The top bits of eight bytes as one byte.
std::uint64_t gathered(std::uint64_t bytes) {
  constexpr std::uint64_t lowest = 0x0101010101010101;
  constexpr std::uint64_t to_top_byte = 0x0102040810204080;
  return (bytes >> 7U & lowest) * to_top_byte >> 56U;
}

/// A bit for each cell, set where the byte that `is` makes of it has its top bit set.
template <class Is>
std::uint64_t bits(const Brick& brick, Is&& is) {
  std::uint64_t mask = 0;
  for (unsigned row = 0; row < 8; ++row) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, brick.cells.data() + 8 * row, sizeof bytes);
    mask |= gathered(is(bytes)) << 8 * row;
  }
  return mask;
}

}  // namespace

std::uint64_t occupied_cells(const Brick& brick) {
  return bits(brick, [](std::uint64_t cells) { return ~cells; });  // no sign
}

std::uint64_t unknown_cells(const Brick& brick) {
  // 0x80 alone: the sign, and no carry out of the other seven bits.
  constexpr std::uint64_t low_bits = 0x7f7f7f7f7f7f7f7f;
  return bits(brick, [](std::uint64_t cells) { return cells & ~((cells & low_bits) + low_bits); });
}

}  // namespace flyball
