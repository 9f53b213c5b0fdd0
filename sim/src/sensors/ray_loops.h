// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The innermost loops of the depth camera: a tile of rays against one solid, and noise. Written
/// once, in the compiler's portable vector types (`ray_loops.inc`), and compiled for several
/// instruction sets, of which the processor's widest is taken at run time. All give the same bits
/// on every processor: sums, products and quotients as IEEE 754 rounds them, no approximate
/// reciprocals, no fused multiply-add.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flyball {

inline constexpr std::size_t tile_width = 16;
inline constexpr std::size_t tile_height = 8;
inline constexpr std::size_t tile_pixels = tile_width * tile_height;
using TileFloats = std::array<float, tile_pixels>;  ///< Row by row.

/// The rays of a tile: all from the camera, directions of length 1 along its axis, so that the
/// parameter of a point on a ray is its depth.
struct alignas(64) TileRays {
  std::array<TileFloats, 3> way_W;    ///< No coordinate is zero.
  std::array<TileFloats, 3> inverse;  ///< 1 / way_W
};

struct alignas(64) TileDepths {
  TileFloats depth_m;  ///< Infinite where nothing was met.
};

/// Directions as a function of the pixel: those at the tile's first pixel, and steps to the next.
struct TileAim {
  std::array<float, 3> first_W;
  std::array<float, 3> right_W;
  std::array<float, 3> down_W;
};

/// Between two corners, both from the camera [m].
struct BoxOffset {
  std::array<float, 3> low;
  std::array<float, 3> high;
};

/// Upright, between two heights, all from the camera [m]: the prism of 24 faces around it, as
/// `solid_mesh` has it.
struct PillarOffset {
  float x;
  float y;
  float radius_m;
  float low_z;
  float high_z;
};

/// What a depth camera adds to what it sees.
struct DepthNoise {
  bool is_rgbd;        ///< Of MAVBench's RGB-D model (its code).
  double extra_m;      ///< Standard deviation that comes on top.
  double least_m;      ///< Noise does not push a surface nearer.
  double max_range_m;  ///< Farther is nothing.
};

/// Each `meet` takes the nearer of the depths that stand there and the solid's, where the latter is
/// not beyond the range. From inside a solid its far side is seen. The greatest depth comes back.
struct RayLoops {
  void (*aim)(const TileAim& aim, TileRays& rays);
  float (*meet_ground)(const TileRays& rays, float height_m, float range_m, TileDepths& seen);
  float (*meet_box)(const TileRays& rays, const BoxOffset& box, float range_m, TileDepths& seen);
  float (*meet_pillar)(const TileRays& rays,
                       const PillarOffset& pillar,
                       float range_m,
                       TileDepths& seen);
  /// Adds noise to all depths that are not infinite: each takes the next two draws of the stream
  /// of which this is the state (`RandomStream::state`).
  void (*add_noise)(const DepthNoise& noise,
                    std::uint64_t state,
                    std::size_t count,
                    float* depth_m);
};

/// Those that this processor can run, the widest last.
[[nodiscard]] std::vector<const RayLoops*> supported_ray_loops();

}  // namespace flyball
