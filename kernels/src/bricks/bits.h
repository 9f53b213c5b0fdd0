// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Bits of a word, one by one. (std::bitset counts by a library call where the processor that is
/// compiled for has no such instruction.)

#include <cstddef>
#include <cstdint>

namespace flyball {

[[nodiscard]] inline std::size_t count_bits(std::uint64_t bits) {
  bits -= bits >> 1U & 0x5555555555555555;
  bits = (bits & 0x3333333333333333) + (bits >> 2U & 0x3333333333333333);
  bits = (bits + (bits >> 4U)) & 0x0f0f0f0f0f0f0f0f;
  return bits * 0x0101010101010101 >> 56U;
}

/// @pre `bits` is not 0.
[[nodiscard]] inline std::size_t lowest_bit(std::uint64_t bits) {
  return static_cast<std::size_t>(__builtin_ctzll(bits));
}

}  // namespace flyball
