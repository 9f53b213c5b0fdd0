// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The innermost loops of the brick map. Each is written once, in the compiler's portable vector
/// types (`inner_loops.inc`), and compiled for several instruction sets, of which the processor's
/// widest is taken at run time. All of them give the same bits: integers, or floats in one fixed
/// order without fused multiply-add.

#include "brick.h"
#include <array>
#include <cstdint>
#include <vector>

namespace flyball {

enum class Simd : std::uint8_t {
  portable,  ///< What the target always has: SSE2, NEON, or plain code.
  avx2,
  avx512,
};

/// What this processor can run, widest last.
[[nodiscard]] std::vector<Simd> supported_simd();
[[nodiscard]] Simd widest_simd();

/// Sixteen rays that step from cell to cell. Times at which they cross the next border are integers
/// (see ray_scan.h); a cell's place in the window is the sum of three spread coordinates (see
/// mark_window.h).
struct alignas(64) RayBlock {
  static constexpr std::size_t lanes = 16;
  template <class T>
  using Lanes = std::array<T, lanes>;

  std::array<Lanes<std::int32_t>, 3> next_t;
  std::array<Lanes<std::int32_t>, 3> delta_t;
  std::array<Lanes<std::uint32_t>, 3> step;   ///< One cell forward or, modulo 2^32, back.
  std::array<Lanes<std::uint32_t>, 3> carry;  ///< Bits that a step forward must carry across.
  Lanes<std::int32_t> closest;  ///< Out: least time between two borders that were crossed in turn.
};

struct WindowAxes {
  std::array<std::uint32_t, 3> bits;   ///< Which bits of a place belong to the axis.
  std::array<std::uint32_t, 3> start;  ///< Where the rays begin.
};

/// A depth image, set up for the cells of one brick at a time.
struct alignas(64) CellProbe {
  std::array<std::array<float, 64>, 3> offset_C;  ///< From the brick's centre to its cells' [m].
  float focal_px;
  float centre_u_px;
  float centre_v_px;
  float nearest_m;
  float squared_range_m2;
  float half_cell_m;
  int width_px;
  int height_px;
  const float* depth_m;
};

struct InnerLoops {
  /// Frees and hits the cells of two masks that have no bit in common.
  BlockSummary (*update_brick)(Brick& brick, std::uint64_t free, std::uint64_t hit);
  /// Writes the first `steps` places of each lane: lane l of step k to `places[16 k + l]`.
  void (*walk_rays)(RayBlock& rays, const WindowAxes& axes, int steps, std::uint32_t* places);
  /// Which cells of the brick around `centre_C` are in view, in range, and nearer by half a cell
  /// than the depth of the pixel in which their centre is.
  std::uint64_t (*seen_cells)(const CellProbe& probe, const float* centre_C);
};

/// @pre `simd` is supported.
[[nodiscard]] const InnerLoops& inner_loops(Simd simd);

}  // namespace flyball
