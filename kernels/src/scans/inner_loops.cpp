// SPDX-License-Identifier: BSD-3-Clause
// tested-in: brick_map
#include "inner_loops.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace flyball {
namespace {

constexpr int half_keys = 32768;
constexpr double latest_unit = (1 << 30) - 1.0;  // twice this still fits into an integer
constexpr double least_direction = 1e-12;        // so slow that no border is ever reached

/// The top bits of eight bytes as one byte.
[[maybe_unused]] inline std::uint64_t gathered(std::uint64_t bytes) {
  constexpr std::uint64_t lowest = 0x0101010101010101;
  constexpr std::uint64_t to_top_byte = 0x0102040810204080;
  return (bytes >> 7U & lowest) * to_top_byte >> 56U;
}

// The pragmas, and not flags for a file, set the instruction set: they do not reach the inline
// functions of other headers, of which the linker keeps one copy for the whole program.
namespace portable {
constexpr std::size_t vector_bytes = 16;
using Doubles [[gnu::vector_size(vector_bytes)]] = double;
inline Doubles roots(const Doubles& numbers) {
  return Doubles{std::sqrt(numbers[0]), std::sqrt(numbers[1])};
}
using Singles [[gnu::vector_size(vector_bytes)]] = float;
inline Singles roots(const Singles& numbers) {
  return Singles{std::sqrt(numbers[0]), std::sqrt(numbers[1]), std::sqrt(numbers[2]),
                 std::sqrt(numbers[3])};
}
using Bytes [[gnu::vector_size(vector_bytes)]] = signed char;
/// All bits of a byte, or none, for each of the lowest bits of a mask.
inline Bytes bytes_of(std::uint64_t mask) {
  constexpr std::uint64_t copies = 0x0101010101010101;
  constexpr std::uint64_t one_bit_each = 0x8040201008040201;
  const std::uint64_t rows[2] = {(mask & 0xff) * copies & one_bit_each,
                                 (mask >> 8U & 0xff) * copies & one_bit_each};
  Bytes bytes;
  std::memcpy(&bytes, rows, sizeof bytes);
  return bytes != 0;
}
/// The top bits of the bytes.
inline std::uint64_t sign_bits(const Bytes& bytes) {
#if defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_epi8(reinterpret_cast<__m128i>(bytes)));
#else
  std::uint64_t rows[2];
  std::memcpy(rows, &bytes, sizeof rows);
  return gathered(rows[0]) | gathered(rows[1]) << 8U;
#endif
}
/// Whether it did: not here, where the plain loop is faster.
inline bool mark_distinct(const Lanes<std::int32_t>& /*steps*/,
                          const std::uint32_t* /*places*/,
                          std::uint8_t /*mark*/,
                          std::uint8_t* /*marks*/) {
  return false;
}
#include "inner_loops.inc"
#include "view_loops.inc"
#include "view_meetings.inc"
#include "view_octants.inc"
}  // namespace portable

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
constexpr std::size_t vector_bytes = 32;
using Doubles [[gnu::vector_size(vector_bytes)]] = double;
inline Doubles roots(const Doubles& numbers) {
  return Doubles(_mm256_sqrt_pd(__m256d(numbers)));
}
using Singles [[gnu::vector_size(vector_bytes)]] = float;
inline Singles roots(const Singles& numbers) {
  return Singles(_mm256_sqrt_ps(__m256(numbers)));
}
using Bytes [[gnu::vector_size(vector_bytes)]] = signed char;
inline Bytes bytes_of(std::uint64_t mask) {
  // Each byte of the mask goes to eight bytes, of which each keeps one bit.
  const __m256i copies = _mm256_shuffle_epi8(
      _mm256_set1_epi32(static_cast<int>(mask)),
      _mm256_setr_epi64x(0, 0x0101010101010101, 0x0202020202020202, 0x0303030303030303));
  const __m256i one_bit_each = _mm256_set1_epi64x(static_cast<long long>(0x8040201008040201));
  return reinterpret_cast<Bytes>(_mm256_and_si256(copies, one_bit_each)) != 0;
}
inline std::uint64_t sign_bits(const Bytes& bytes) {
  return static_cast<std::uint32_t>(_mm256_movemask_epi8(reinterpret_cast<__m256i>(bytes)));
}
inline bool mark_distinct(const Lanes<std::int32_t>& /*steps*/,
                          const std::uint32_t* /*places*/,
                          std::uint8_t /*mark*/,
                          std::uint8_t* /*marks*/) {
  return false;
}
#include "inner_loops.inc"
#include "view_loops.inc"
#include "view_meetings.inc"
#include "view_octants.inc"
}  // namespace avx2
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
namespace avx512 {
constexpr std::size_t vector_bytes = 64;
using Doubles [[gnu::vector_size(vector_bytes)]] = double;
inline Doubles roots(const Doubles& numbers) {
  // Zero-masked, for GCC 12 warns of what the plain one leaves unset.
  return Doubles(_mm512_maskz_sqrt_pd(0xff, __m512d(numbers)));
}
using Singles [[gnu::vector_size(vector_bytes)]] = float;
inline Singles roots(const Singles& numbers) {
  return Singles(_mm512_maskz_sqrt_ps(0xffff, __m512(numbers)));
}
using Bytes [[gnu::vector_size(vector_bytes)]] = signed char;
inline Bytes bytes_of(std::uint64_t mask) {
  return reinterpret_cast<Bytes>(_mm512_movm_epi8(mask));
}
inline std::uint64_t sign_bits(const Bytes& bytes) {
  return _mm512_movepi8_mask(reinterpret_cast<__m512i>(bytes));
}
/// Neighbouring rays cross the same cells at about the same steps: of equal places side by side
/// only the first is marked.
inline bool mark_distinct(const Lanes<std::int32_t>& steps,
                          const std::uint32_t* places,
                          std::uint8_t mark,
                          std::uint8_t* marks) {
  alignas(64) std::uint32_t distinct[lanes];
  const __m512i last = _mm512_loadu_si512(steps.data());
  const int most_steps = *std::max_element(steps.begin(), steps.end());
  for (int k = 0; k < most_steps; ++k) {
    const __m512i here = _mm512_loadu_si512(places + lanes * static_cast<std::size_t>(k));
    const __mmask16 walks = _mm512_cmpgt_epi32_mask(last, _mm512_set1_epi32(k));
    const __m512i before = _mm512_maskz_alignr_epi32(0xffff, here, here, 15);
    const auto same = static_cast<unsigned>(_mm512_cmpeq_epi32_mask(here, before));
    const unsigned marked_before = same & static_cast<unsigned>(walks) << 1U;
    const unsigned left = static_cast<unsigned>(walks) & ~marked_before;
    _mm512_store_si512(distinct, _mm512_maskz_compress_epi32(static_cast<__mmask16>(left), here));
    const int count = __builtin_popcount(left);
    for (int i = 0; i < count; ++i) {
      marks[distinct[i]] = mark;
    }
  }
  return true;
}
#include "inner_loops.inc"
#include "view_loops.inc"
#include "view_meetings.inc"
#include "view_octants.inc"
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
  static constexpr InnerLoops of_portable = portable::loops;
  static constexpr InnerLoops of_avx2 = avx2::loops;
  static constexpr InnerLoops of_avx512 = avx512::loops;
  return simd == Simd::avx512 ? of_avx512 : simd == Simd::avx2 ? of_avx2 : of_portable;
}

}  // namespace flyball
