// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The innermost loops of the brick map. Each is written once, in the compiler's portable vector
/// types (`inner_loops.inc`), and compiled for several instruction sets, of which the processor's
/// widest is taken at run time. All of them give the same bits: integers, or floats in one fixed
/// order without fused multiply-add.

#include "flyball/runtime/geometry.h"

#include "bricks/brick.h"
#include "meetings.h"
#include <array>
#include <cstdint>
#include <vector>

namespace flyball {

enum class Simd : std::uint8_t {
  portable,  ///< What the compiler makes of them for any processor: SSE2, NEON, or plain code.
  neon,      ///< And by hand, what it does not find by itself on 64-bit Arm.
  avx2,
  avx512,
};

/// What this processor can run, widest last.
[[nodiscard]] std::vector<Simd> supported_simd();
[[nodiscard]] Simd widest_simd();

/// Sixteen points, and the cells in which they are. The lanes beyond the last point repeat it.
struct alignas(64) PointBlock {
  std::array<Lanes<float>, 3> p;  ///< [m]
  std::array<Lanes<std::int32_t>, 3> key;
  Lanes<std::int32_t> reaches;  ///< Not 0 where the point is within the range.

  /// @param count  1 to 16.
  template <class Point>
  void take(const Point* points, std::size_t count) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Point& point = points[lane < count ? lane : count - 1];
      p[0][lane] = point.x();
      p[1][lane] = point.y();
      p[2][lane] = point.z();
    }
  }
};

/// What all rays of a scan have in common.
struct RayFrame {
  std::array<float, 3> origin_W;
  double range_m;
  double cell_m;
  double cells_per_m;
  std::array<std::int32_t, 3> start;              ///< Key of the cell of the origin.
  std::array<std::array<double, 2>, 3> border_m;  ///< From the origin back and on to its borders.
  double units_per_m;                             ///< Of the integer times; see ray_scan.h.
};

/// Sixteen rays that step from cell to cell. Times at which they cross the next border are integers
/// (see ray_scan.h); a cell's place in the window is the sum of three spread coordinates (see
/// mark_window.h).
struct alignas(64) RayBlock {
  std::array<Lanes<std::int32_t>, 3> next_t;
  std::array<Lanes<std::int32_t>, 3> delta_t;
  std::array<Lanes<std::uint32_t>, 3> step;   ///< One cell forward or, modulo 2^32, back.
  std::array<Lanes<std::uint32_t>, 3> carry;  ///< Bits that a step forward must carry across.
  Lanes<std::int32_t> steps;                  ///< To the end's cell.
  Lanes<std::int32_t> is_sure;                ///< Not 0 where no rounding can hide the end.
  Lanes<std::int32_t> closest;  ///< Out: least time between two borders that were crossed in turn.
};

struct WindowAxes {
  std::array<std::uint32_t, 3> unit;   ///< The step along the axis.
  std::array<std::uint32_t, 3> bits;   ///< Which bits of a place belong to the axis.
  std::array<std::uint32_t, 3> start;  ///< Where the rays begin.
};

/// From C to W, row by row.
using PoseRows = std::array<std::array<double, 4>, 3>;

[[nodiscard]] inline PoseRows rows_of(const Pose& X_WC) {
  PoseRows rows{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      rows[row][column] = X_WC.matrix()(static_cast<int>(row), static_cast<int>(column));
    }
  }
  return rows;
}

/// Where a point of C is seen.
struct PixelGrid {
  float focal_px;
  float centre_u_px;  ///< A pixel's ray passes through its middle: half a pixel is added to both.
  float centre_v_px;
  std::int32_t width_px;
  std::int32_t height_px;

  [[nodiscard]] bool operator==(const PixelGrid& other) const {
    return focal_px == other.focal_px && centre_u_px == other.centre_u_px &&
           centre_v_px == other.centre_v_px && width_px == other.width_px &&
           height_px == other.height_px;
  }
};

/// How points of C become cells of W.
struct HitFrame {
  PoseRows X_WC;
  std::array<float, 3> origin_W;
  float squared_range_m2;  ///< The greatest squared length that is within the range.
  double cells_per_m;
  WindowChunks window;
};

/// Two rows of a scale of a depth pyramid, each as its least and its greatest depths.
struct DepthRows {
  std::array<const float*, 2> least;
  std::array<const float*, 2> most;
};

/// A depth image, set up for the cells of one brick at a time.
struct alignas(64) CellProbe {
  std::array<std::array<float, 64>, 3> offset_C;  ///< From the brick's centre to its cells' [m].
  PixelGrid grid;
  float nearest_m;
  float squared_range_m2;
  float half_cell_m;
  const float* depth_m;
};

/// One scale of a depth pyramid. Four numbers may be read from any texel on.
struct DepthScale {
  const float* least;
  const float* most;
  int width;
};

/// A depth image, set up for the eighths of cubes of one level.
struct alignas(32) OctantProbe {
  std::array<std::array<float, 8>, 3> offset_C;  ///< From a cube's centre to its octants' [m].
  std::array<float, 3> half_C;                   ///< Of the box of C around an octant [m].
  float nearest_m;
  float squared_near_m2;  ///< Centres nearer than this: the octant is in range as a whole.
  float squared_far_m2;   ///< Centres farther than this: it is out of range.
  PixelGrid grid;
  const DepthScale* scales;
  int scales_count;
};

/// A bit for each octant; none where it is behind every surface, out of view or out of range.
struct OctantVisibility {
  std::uint32_t whole;  ///< In view, in range, and nearer than the least depth behind it.
  std::uint32_t part;   ///< Perhaps some of it is seen.
};

/// Words, those that stand before them and those that stand after them.
struct WordColumns {
  const std::uint64_t* words;
  const std::uint64_t* before;
  const std::uint64_t* after;
  std::size_t count;
};

struct InnerLoops {
  /// Frees and hits the cells of two masks that have no bit in common. Returns all its cells.
  CellMasks (*update_brick)(Brick& brick, std::uint64_t free, std::uint64_t hit);
  /// Finds the cells of points of C, taken to W through doubles and back to floats: 64 times the
  /// brick's place in the window plus the cell's bit. -1 beyond the range and outside the window.
  void (*locate_hits)(const PointBlock& points, const HitFrame& frame, Lanes<std::int32_t>& cells);
  /// Cuts rays to the range in OctoMap's arithmetic, and finds the cells of their ends.
  void (*cut_rays)(PointBlock& ends, const RayFrame& frame);
  /// Sets rays up to walk.
  void (*aim_rays)(const PointBlock& ends,
                   const RayFrame& frame,
                   const WindowAxes& axes,
                   RayBlock& rays);
  /// Writes the first `steps` places of each lane: lane l of step k to `places[16 k + l]`.
  void (*walk_rays)(RayBlock& rays, const WindowAxes& axes, int steps, std::uint32_t* places);
  /// Marks the first `steps` places of each lane, as `walk_rays` wrote them.
  void (*mark_places)(const Lanes<std::int32_t>& steps,
                      const std::uint32_t* places,
                      std::uint8_t mark,
                      std::uint8_t* marks);
  /// Sets the depths of the pixels in which points of C are seen, infinite where they are farther
  /// than the range. Outside the image and behind it: the pixel after the last.
  void (*put_depths)(const PointBlock& points,
                     const PixelGrid& grid,
                     float squared_range_m2,
                     float* depth_m);
  /// Least and greatest depths of 2 x 2 blocks: `blocks` of them, each from two texels of a row.
  void (*halve_rows)(const DepthRows& rows, std::size_t blocks, float* least, float* most);
  /// Adds the bits of two rows of words to a third.
  void (*join_words)(std::uint64_t* out,
                     const std::uint64_t* a,
                     const std::uint64_t* b,
                     std::size_t count);
  /// Spreads the bits of words by `cells` (1 to 63) to either side, also out of the neighbours.
  void (*widen_words)(const WordColumns& from, unsigned cells, std::uint64_t* out);
  /// Which cells of the brick around `centre_C` are in view, in range, and nearer by half a cell
  /// than the depth of the pixel in which their centre is.
  std::uint64_t (*seen_cells)(const CellProbe& probe, const float* centre_C);
  /// What the image says about the eighths of the cube around `centre_C`.
  OctantVisibility (*see_octants)(const OctantProbe& probe, const float* centre_C);
  /// The same, when only those seen as a whole matter.
  std::uint32_t (*whole_octants)(const OctantProbe& probe, const float* centre_C);
  /// Where rays end, as depths: infinite beyond the range, 0 where nothing was measured.
  void (*lay_depths)(const PixelDepths& pixels, std::size_t count, float* depth_m);
  /// The points of sixteen pixels of a row. @param x  Where their columns look; `y`: their row.
  void (*take_pixels)(
      const PixelDepths& pixels, const float* x, float y, PointBlock& points, PixelKinds& kinds);
  /// Counts what rays to points of C cross, by the cells of their ends.
  /// @param kinds  No ray beyond the last pixel.
  void (*settle_rays)(const PointBlock& points_C,
                      const PixelKinds& kinds,
                      const EndFrame& frame,
                      RayEnds& settled);
  /// Asks every `row_step`-th row of the pixels, until one is sure.
  Crossing (*cross_box)(const PixelProbe& probe,
                        const BoxOfCell& box,
                        const PixelBlock& pixels,
                        int row_step);
  /// Takes sixteen points, three numbers each.
  void (*split_points)(const float* points, PointBlock& block);
  /// Takes sixteen points of C to W, through doubles and back to floats, and puts them one after
  /// the other.
  void (*move_to_world)(const PointBlock& points, const PoseRows& X_WC, float* points_W);
};

/// @param count  1 to 16. The lanes beyond the last point repeat it.
template <class Point>
void take_points(const InnerLoops& loops,
                 const Point* points,
                 std::size_t count,
                 PointBlock& block) {
  static_assert(sizeof(Point) == 3 * sizeof(float));
  if (count == lanes) {
    loops.split_points(&points->x(), block);
  } else {
    block.take(points, count);
  }
}

/// By how many units the gap of two rounded crossings may be wrong: each began half a unit off, and
/// went half a unit further off with every step.
[[nodiscard]] constexpr int doubt_units(int steps) {
  return steps / 2 + 3;
}

/// @pre `simd` is supported.
[[nodiscard]] const InnerLoops& inner_loops(Simd simd);

}  // namespace flyball
