// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The three keys of a finest cell side by side in one word, so that a question finds its chunk,
/// its brick and its bit with a few instructions for all axes at once. x takes the lowest 16 bits,
/// y those from bit 21, z those from bit 42.
///
/// Bits of the three axes are brought together by a product: each term moves one axis to its place
/// below the top, and where the other terms put it is below that place, or past the top.

#include "bricks/lattice.h"
#include <array>
#include <cstddef>
#include <cstdint>

namespace flyball {

using PackedCell = std::uint64_t;

namespace packed {

inline constexpr unsigned y_bit = 21;
inline constexpr unsigned z_bit = 42;

/// Bits of the three axes.
[[nodiscard]] constexpr std::uint64_t bits(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return x | y << y_bit | z << z_bit;
}

/// Two coordinates, and two keys.
using Pair [[gnu::vector_size(16)]] = double;
using PairKeys [[gnu::vector_size(16)]] = std::int64_t;

/// Rounded down as Lattice::key does it. Has the bits of `whole` above the lowest 16, unless the
/// lattice has no such key or the number is not finite.
[[nodiscard]] inline PairKeys keys(const Pair& x_m, double cells_per_m) {
  // The sum's last bit is a whole: its low bits are the number, rounded to nearest.
  constexpr Pair shift{0x1.8p52 + Lattice::half_keys, 0x1.8p52 + Lattice::half_keys};
  const Pair cells = x_m * cells_per_m;
  const Pair shifted = cells + shift;
  const Pair rounded = shifted - shift;
  return PairKeys(shifted) + PairKeys(rounded > cells);  // -1 where it is above
}
inline constexpr std::uint64_t whole = 0x4338000000000000;  // 1.5 * 2^52 as a double
inline constexpr std::uint64_t key_bits = 0xffff;

/// False where `cell` is no cell of the lattice.
[[nodiscard]] inline bool pack(const Vec3& p, double cells_per_m, PackedCell& cell) {
  const PairKeys xy = keys(Pair{p.x(), p.y()}, cells_per_m);
  const PairKeys z0 = keys(Pair{p.z(), 0.0}, cells_per_m);
  const auto x = static_cast<std::uint64_t>(xy[0]);
  const auto y = static_cast<std::uint64_t>(xy[1]);
  const auto z = static_cast<std::uint64_t>(z0[0]);
  cell = bits(x & key_bits, y & key_bits, z & key_bits);
  return ((x ^ y) | (x ^ z) | (x ^ whole)) <= key_bits;
}

/// What of a cell names its chunk.
[[nodiscard]] inline std::uint64_t chunk(PackedCell cell) {
  return cell & bits(0xffe0, 0xffe0, 0xffe0);
}
/// The same of a chunk's key.
[[nodiscard]] inline std::uint64_t chunk(const CellKey& key) {
  const auto unsigned_key = [](int k) { return std::uint64_t{static_cast<std::uint32_t>(k)}; };
  return unsigned_key(key.x) << 5U ^ unsigned_key(key.y) << (5U + y_bit) ^
         unsigned_key(key.z) << (5U + z_bit);
}

/// The lowest 5, 5 and 3 bits of a chunk's keys in one number: z y x.
[[nodiscard]] inline std::size_t near_number(std::uint64_t cell) {
  constexpr std::uint64_t gather =
      std::uint64_t{1} << 46U | std::uint64_t{1} << 30U | std::uint64_t{1} << 14U;
  return (cell & bits(31U << 5U, 31U << 5U, 7U << 5U)) * gather >> 51U;
}

/// A brick's place in its chunk, row by row, x fastest: not its number, which is in Morton order.
[[nodiscard]] inline std::size_t brick_place(PackedCell cell) {
  constexpr std::uint64_t gather =
      std::uint64_t{1} << 53U | std::uint64_t{1} << 35U | std::uint64_t{1} << 17U;
  return (cell & bits(7U << 2U, 7U << 2U, 7U << 2U)) * gather >> 55U;
}

/// The numbers of the bricks at these places.
[[nodiscard]] constexpr std::array<std::uint16_t, 512> brick_numbers() {
  std::array<std::uint16_t, 512> numbers{};
  for (unsigned place = 0; place < 512; ++place) {
    unsigned number = 0;
    for (unsigned bit = 0; bit < 3; ++bit) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        number |= (place >> (3 * axis + bit) & 1U) << (3 * bit + axis);
      }
    }
    numbers[place] = static_cast<std::uint16_t>(number);
  }
  return numbers;
}
inline constexpr std::array<std::uint16_t, 512> brick_number_at = brick_numbers();

/// In its brick.
[[nodiscard]] inline unsigned bit(PackedCell cell) {
  constexpr std::uint64_t gather =
      std::uint64_t{1} << 58U | std::uint64_t{1} << 39U | std::uint64_t{1} << 20U;
  return static_cast<unsigned>((cell & bits(3, 3, 3)) * gather >> 58U);
}

}  // namespace packed
}  // namespace flyball
