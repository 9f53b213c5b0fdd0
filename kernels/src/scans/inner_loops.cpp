// SPDX-License-Identifier: BSD-3-Clause
// tested-in: brick_map
#include "inner_loops.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__ARM_NEON)
#include <arm_neon.h>
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

#if defined(__aarch64__) && defined(__ARM_NEON)
// The compiler makes NEON of the portable loops too. This has what it does not find by itself.
namespace neon {
constexpr std::size_t vector_bytes = 16;
using Doubles [[gnu::vector_size(vector_bytes)]] = double;
inline Doubles roots(const Doubles& numbers) {
  return Doubles(vsqrtq_f64(numbers));
}
using Singles [[gnu::vector_size(vector_bytes)]] = float;
inline Singles roots(const Singles& numbers) {
  return Singles(vsqrtq_f32(numbers));
}
using Bytes [[gnu::vector_size(vector_bytes)]] = signed char;
inline uint8x16_t one_bit_each() {
  return vreinterpretq_u8_u64(vdupq_n_u64(0x8040201008040201));
}
inline Bytes bytes_of(std::uint64_t mask) {
  const uint8x8_t low = vdup_n_u8(static_cast<std::uint8_t>(mask));
  const uint8x8_t high = vdup_n_u8(static_cast<std::uint8_t>(mask >> 8U));
  return Bytes(vtstq_u8(vcombine_u8(low, high), one_bit_each()));
}
inline std::uint64_t sign_bits(const Bytes& bytes) {
  const uint8x16_t bits =
      vandq_u8(vreinterpretq_u8_s8(vshrq_n_s8(int8x16_t(bytes), 7)), one_bit_each());
  // Side by side the bits of both halves; the sum of the pairs has no carry.
  const uint8x16_t pairs = vzip1q_u8(bits, vextq_u8(bits, bits, 8));
  return vaddvq_u16(vreinterpretq_u16_u8(pairs));
}
using Ints [[gnu::vector_size(vector_bytes)]] = std::int32_t;
using HalfInts [[gnu::vector_size(vector_bytes / 2)]] = std::int32_t;
using HalfFloats [[gnu::vector_size(vector_bytes / 2)]] = float;
inline Doubles in_double(const HalfFloats& numbers) {
  return Doubles(vcvt_f64_f32(numbers));
}
inline Doubles in_double(const HalfInts& numbers) {
  return Doubles(vcvtq_f64_s64(vmovl_s32(numbers)));
}
inline HalfInts floored(const Doubles& numbers) {
  return HalfInts(vmovn_s64(vcvtmq_s64_f64(numbers)));
}
inline Ints floored(const Singles& numbers) {
  return Ints(vcvtmq_s32_f32(numbers));
}
inline bool is_any(const Ints& lanes) {
  return vmaxvq_u32(vreinterpretq_u32_s32(int32x4_t(lanes))) != 0;
}
inline bool is_all(const Ints& lanes) {
  return vminvq_u32(vreinterpretq_u32_s32(int32x4_t(lanes))) != 0;
}
inline std::uint32_t bits_of(const std::array<std::int32_t, 8>& words) {
  constexpr std::uint16_t places[8] = {1, 2, 4, 8, 16, 32, 64, 128};
  const int16x8_t narrow =
      vcombine_s16(vmovn_s32(vld1q_s32(words.data())), vmovn_s32(vld1q_s32(words.data() + 4)));
  return vaddvq_u16(vandq_u16(vreinterpretq_u16_s16(narrow), vld1q_u16(places)));
}
inline void split_points(const float* points, PointBlock& block) {
  for (std::size_t at = 0; at < flyball::lanes; at += 4) {
    const float32x4x3_t axes = vld3q_f32(points + 3 * at);
    vst1q_f32(&block.p[0][at], axes.val[0]);
    vst1q_f32(&block.p[1][at], axes.val[1]);
    vst1q_f32(&block.p[2][at], axes.val[2]);
  }
}
inline void join_points(const std::array<Lanes<float>, 3>& axes, float* points) {
  for (std::size_t at = 0; at < flyball::lanes; at += 4) {
    vst3q_f32(points + 3 * at,
              {vld1q_f32(&axes[0][at]), vld1q_f32(&axes[1][at]), vld1q_f32(&axes[2][at])});
  }
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
}  // namespace neon
constexpr bool has_neon = true;
#else
namespace neon = portable;
constexpr bool has_neon = false;
#endif

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
  if (simd == Simd::neon) {
    return has_neon;
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
  for (const Simd simd : {Simd::portable, Simd::neon, Simd::avx2, Simd::avx512}) {
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
  static constexpr InnerLoops of_neon = neon::loops;
  static constexpr InnerLoops of_avx2 = avx2::loops;
  static constexpr InnerLoops of_avx512 = avx512::loops;
  switch (simd) {
    case Simd::portable:
      return of_portable;
    case Simd::neon:
      return of_neon;
    case Simd::avx2:
      return of_avx2;
    case Simd::avx512:
      return of_avx512;
  }
  return of_portable;
}

}  // namespace flyball
