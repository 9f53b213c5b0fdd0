// SPDX-License-Identifier: BSD-3-Clause
// tested-in: solid_rays
#include "ray_loops.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace flyball {
namespace {

constexpr float least_way = 1e-12F;  // its inverse, and that times a world, are finite

// The pragmas, and not flags for a file, set the instruction set: they do not reach the inline
// functions of other headers, of which the linker keeps one copy for the whole program.
namespace portable {
constexpr std::size_t vector_bytes = 16;
using Floats [[gnu::vector_size(vector_bytes)]] = float;
inline Floats root(const Floats& squares) {
  return Floats{std::sqrt(squares[0]), std::sqrt(squares[1]), std::sqrt(squares[2]),
                std::sqrt(squares[3])};
}
#include "ray_loops.inc"
}  // namespace portable

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
constexpr std::size_t vector_bytes = 32;
using Floats [[gnu::vector_size(vector_bytes)]] = float;
inline Floats root(const Floats& squares) {
  return Floats(_mm256_sqrt_ps(__m256(squares)));
}
#include "ray_loops.inc"
}  // namespace avx2
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
namespace avx512 {
constexpr std::size_t vector_bytes = 64;
using Floats [[gnu::vector_size(vector_bytes)]] = float;
inline Floats root(const Floats& squares) {
  // Zero-masked, for GCC 12 warns of what the plain one leaves unset.
  return Floats(_mm512_maskz_sqrt_ps(0xffff, __m512(squares)));
}
#include "ray_loops.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

}  // namespace

std::vector<const RayLoops*> supported_ray_loops() {
  std::vector<const RayLoops*> supported{&portable::loops};
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (__builtin_cpu_supports("avx2") != 0) {
    supported.push_back(&avx2::loops);
  }
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
      __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0) {
    supported.push_back(&avx512::loops);
  }
#endif
  return supported;
}

}  // namespace flyball
