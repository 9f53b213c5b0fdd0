// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Sixty-four cells in one cache line.

#include "lattice.h"
#include <array>
#include <cstdint>

namespace flyball {

/// Log-odds of a cell in a byte. OctoMap's update in floats (hit p = .7, miss p = .4, clamped to
/// .12 and .97) and this one agree on free or occupied for every sequence of up to 62 hits and
/// misses: of all byte-sized steps and clamps these do so longest (exhaustive search over
/// sequences, see tests/kernels/brick_test.cpp).
namespace log_odds {
inline constexpr std::int8_t unknown = -128;
inline constexpr std::int8_t hit = 25;
inline constexpr std::int8_t miss = -12;
inline constexpr std::int8_t least = -59;
inline constexpr std::int8_t most = 103;
/// Also for the maximum over cells: a known one outweighs unknown ones.
[[nodiscard]] inline constexpr bool is_occupied(std::int8_t cell) {
  return cell >= 0;
}
}  // namespace log_odds

/// A brick's steps in one unit of OctoMap's log-odds: a miss of 12 is its log(.4 / .6) = -.405, a
/// hit of 25 its log(.7 / .3) = .847.
inline constexpr float log_odds_steps = 29.6F;

struct alignas(64) Brick {
  std::array<std::int8_t, 64> cells;
};

/// The cells of a brick in a state, as bits: cell (x, y, z) is bit 16 z + 4 y + x.
struct CellMasks {
  std::uint64_t occupied{};
  std::uint64_t unknown{~std::uint64_t{0}};
};

struct BrickStates {
  CellKey brick{};  ///< At `brick_level`.
  CellMasks states{};
};

/// What a block of cells holds.
struct BlockSummary {
  bool has_occupied{};
  bool has_unknown{true};
  bool has_known{};
};

}  // namespace flyball
