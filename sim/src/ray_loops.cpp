// SPDX-License-Identifier: BSD-3-Clause
// tested-in: solid_rays
#include "ray_loops.h"

#include <cstdint>
#include <cstring>

namespace flyball {
namespace {

constexpr float least_way = 1e-12F;  // its inverse, and that times a world, are finite

// Outward normals of one face each of the twelve pairs of a prism whose corners stand at multiples
// of 15 degrees: cosines and sines of 7.5 degrees and 15 more for each pair. Numbers, because libm
// rounds differently from processor to processor.
constexpr std::array<std::array<float, 2>, 12> face_pairs{{{0.991444861F, 0.130526192F},
                                                           {0.923879533F, 0.382683432F},
                                                           {0.793353340F, 0.608761429F},
                                                           {0.608761429F, 0.793353340F},
                                                           {0.382683432F, 0.923879533F},
                                                           {0.130526192F, 0.991444861F},
                                                           {-0.130526192F, 0.991444861F},
                                                           {-0.382683432F, 0.923879533F},
                                                           {-0.608761429F, 0.793353340F},
                                                           {-0.793353340F, 0.608761429F},
                                                           {-0.923879533F, 0.382683432F},
                                                           {-0.991444861F, 0.130526192F}}};

// The pragmas, and not flags for a file, set the instruction set: they do not reach the inline
// functions of other headers, of which the linker keeps one copy for the whole program.
namespace portable {
constexpr std::size_t vector_bytes = 16;
#include "ray_loops.inc"
}  // namespace portable

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
constexpr std::size_t vector_bytes = 32;
#include "ray_loops.inc"
}  // namespace avx2
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
namespace avx512 {
constexpr std::size_t vector_bytes = 64;
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
