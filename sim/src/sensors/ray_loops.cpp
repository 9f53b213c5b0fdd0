// SPDX-License-Identifier: BSD-3-Clause
// tested-in: solid_rays
#include "sensors/ray_loops.h"

#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

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

// A normal from a sum of eight 16-bit uniforms, scaled to variance 1: quantiles within 2 % of the
// normal distribution's up to 2.3 sigma, 4 % short at 3 sigma, never beyond 4.9. Box-Muller costs
// more, and its logarithm and cosine differ between processors in the last bit; this does not.
constexpr std::uint64_t every_other = 0x0000ffff0000ffff;
constexpr std::uint64_t low_half = 0xffffffff;
constexpr double sum_mean = 8.0 * 0.5 * 65535.0;
constexpr double sum_sigma = 53509.9;  // sqrt(8 (65536^2 - 1) / 12)

constexpr double bend_m = RgbdNoise::bend_m;
constexpr std::array<double, 2> near_sigma = RgbdNoise::near_sigma;
constexpr std::array<double, 2> far_sigma = RgbdNoise::far_sigma;

double sigma_m(const DepthNoise& noise, double d) {
  const double near = std::max(0.0, near_sigma[0] * d + near_sigma[1]);
  const double far = far_sigma[0] * d + far_sigma[1];
  const double rgbd = noise.is_rgbd ? (d < bend_m ? near : far) : 0.0;
  // Without other noise the root of its square is the number itself, to the bit.
  return noise.extra_m > 0.0 ? std::sqrt(rgbd * rgbd + noise.extra_m * noise.extra_m) : rgbd;
}

/// One depth, with the two draws that follow `state`.
float noisy(const DepthNoise& noise, std::uint64_t state, float depth_m) {
  std::uint64_t pairs = 0;  // sums of four, side by side
  for (const std::uint64_t draw : {1, 2}) {
    const std::uint64_t bits = RandomStream::mix(state + draw * RandomStream::step);
    pairs += (bits & every_other) + (bits >> 16U & every_other);
  }
  const auto sum = static_cast<double>((pairs & low_half) + (pairs >> 32U));
  const double d = static_cast<double>(depth_m);
  const double there =
      std::max(d + sigma_m(noise, d) * ((sum - sum_mean) / sum_sigma), noise.least_m);
  return there <= noise.max_range_m ? static_cast<float>(there)
                                    : std::numeric_limits<float>::infinity();
}

// The pragmas, and not flags for a file, set the instruction set: they do not reach the inline
// functions of other headers, of which the linker keeps one copy for the whole program.
namespace portable {
constexpr std::size_t vector_bytes = 16;
#include "sensors/ray_loops.inc"
#include "sensors/ray_noise.inc"
}  // namespace portable

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
constexpr std::size_t vector_bytes = 32;
#include "sensors/ray_loops.inc"
#include "sensors/ray_noise.inc"
}  // namespace avx2
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
namespace avx512 {
constexpr std::size_t vector_bytes = 64;
#include "sensors/ray_loops.inc"
#include "sensors/ray_noise.inc"
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
