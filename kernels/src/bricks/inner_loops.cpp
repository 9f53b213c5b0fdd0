// SPDX-License-Identifier: BSD-3-Clause
#include "inner_loops.h"

#include <cmath>
#include <cstring>

namespace flyball {
namespace {

constexpr int half_keys = 32768;
constexpr double latest_unit = (1 << 30) - 1.0;  // twice this still fits into an integer
constexpr double least_direction = 1e-12;        // so slow that no border is ever reached

/// One bit of a mask becomes one byte, not zero where the bit is set.
struct alignas(64) ByteMask {
  std::uint64_t rows[8];
};
inline ByteMask byte_mask(std::uint64_t mask) {
  constexpr std::uint64_t copies = 0x0101010101010101;
  constexpr std::uint64_t one_bit_each = 0x8040201008040201;
  ByteMask bytes;
  for (unsigned row = 0; row < 8; ++row) {
    bytes.rows[row] = (mask >> 8 * row & 0xff) * copies & one_bit_each;
  }
  return bytes;
}

/// The lowest bits of eight bytes as one byte.
inline std::uint64_t gathered(std::uint64_t bytes) {
  constexpr std::uint64_t lowest = 0x0101010101010101;
  constexpr std::uint64_t to_top_byte = 0x0102040810204080;
  return (bytes & lowest) * to_top_byte >> 56U;
}

// The pragmas, and not flags for a file, set the instruction set: they do not reach the inline
// functions of other headers, of which the linker keeps one copy for the whole program.
namespace portable {
constexpr std::size_t vector_bytes = 16;
#include "inner_loops.inc"
}  // namespace portable

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
constexpr std::size_t vector_bytes = 32;
#include "inner_loops.inc"
}  // namespace avx2
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
namespace avx512 {
constexpr std::size_t vector_bytes = 64;
#include "inner_loops.inc"
}  // namespace avx512
#pragma GCC pop_options
constexpr bool has_avx = true;
#else
namespace avx2 = portable;
namespace avx512 = portable;
constexpr bool has_avx = false;
#endif

bool runs(Simd simd) {
  if (simd == Simd::portable) {
    return true;
  }
#if defined(__x86_64__)
  if (simd == Simd::avx2) {
    return has_avx && __builtin_cpu_supports("avx2") != 0;
  }
  return has_avx && __builtin_cpu_supports("avx512f") != 0 &&
         __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
#else
  return has_avx;
#endif
}

}  // namespace

std::vector<Simd> supported_simd() {
  std::vector<Simd> supported;
  for (const Simd simd : {Simd::portable, Simd::avx2, Simd::avx512}) {
    if (runs(simd)) {
      supported.push_back(simd);
    }
  }
  return supported;
}

Simd widest_simd() {
  return supported_simd().back();
}

const InnerLoops& inner_loops(Simd simd) {
  static constexpr InnerLoops of_portable{
      portable::update_brick, portable::move_points,    portable::cut_rays,  portable::aim_rays,
      portable::walk_rays,    portable::project_points, portable::seen_cells};
  static constexpr InnerLoops of_avx2{avx2::update_brick, avx2::move_points, avx2::cut_rays,
                                      avx2::aim_rays,     avx2::walk_rays,   avx2::project_points,
                                      avx2::seen_cells};
  // Wider vectors of bytes only add to the sum across lanes.
  static constexpr InnerLoops of_avx512{
      avx2::update_brick, avx512::move_points,    avx512::cut_rays,  avx512::aim_rays,
      avx512::walk_rays,  avx512::project_points, avx512::seen_cells};
  return simd == Simd::avx512 ? of_avx512 : simd == Simd::avx2 ? of_avx2 : of_portable;
}

}  // namespace flyball
