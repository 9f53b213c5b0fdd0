// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the loops of `view_meetings.inc` take and give: rays of a depth image, their ends, and what
/// they cross (see exact_scan.h).

#include <array>
#include <cstddef>
#include <cstdint>

namespace flyball {

/// One value for each of sixteen rays or points.
inline constexpr std::size_t lanes = 16;
template <class T>
using Lanes = std::array<T, lanes>;

/// The cells of a window of chunks (see mask_window.h).
struct WindowChunks {
  std::array<std::int32_t, 3> first;   ///< Key of its first cell.
  std::array<std::int32_t, 3> size;    ///< In cells.
  std::array<std::int32_t, 3> stride;  ///< From chunk to chunk along each axis.
};

/// What settles rays without a walk (see exact_scan.h).
struct EndFrame {
  std::array<std::array<float, 3>, 3> R_WC;
  std::array<float, 3> in_cell;  ///< From the corner of its cell to the origin [m].
  float range_m;
  float cells_per_m;
  float range_doubt_m;         ///< Ends nearer to the range are not sure,
  std::array<float, 3> doubt;  ///< nor those nearer to a border of cells along an axis, in cells;
  float cut_doubt;             ///< where they are cut, by so much more.
  std::array<std::int32_t, 3> start;  ///< Of the origin's cell in the window.
  WindowChunks window;
};

/// Pixels of a depth image side by side, and how far their rays reach. Numbers stand one after the
/// other; `loops` read as many as they are told.
struct PixelDepths {
  const float* depth_m;  ///< Along the optical axis, as all of these.
  const float* reach_m;  ///< Farther ones are rays without return,
  const float* clear_m;  ///< and end there.
  const float* range_m;  ///< Where rays are cut.
};

/// What sixteen pixels are. All bits of a number say yes, none no.
struct alignas(64) PixelKinds {
  Lanes<std::int32_t> is_hit;
  Lanes<std::int32_t> is_ray;   ///< A hit, or clear: not broken.
  Lanes<std::int32_t> is_sure;  ///< No rounding can make a hit of a clear ray.
};

/// What the ends of sixteen rays tell of them.
struct alignas(64) RayEnds {
  /// Of sure hits within the range, as `locate_hits` finds them; -1 for others.
  Lanes<std::int32_t> cells;
  std::int32_t steps;  ///< Cells that the sure ones cross before those of their ends, together.
  std::uint32_t rays;  ///< A bit for each lane that is one,
  std::uint32_t sure;  ///< and for those of which no rounding can put the end elsewhere.
};

/// The rays through the middles of an image's pixels, in W and of depth 1: the sum of what their
/// column and their row says. A vector of pixels or columns may be read from any of them on.
struct PixelProbe {
  std::array<const float*, 3> column_W;
  std::array<const float*, 3> row_W;
  const float* depth_m;  ///< That was seen.
  const float* range_m;  ///< As a depth: where the ray is cut.
  std::int32_t width_px;
  float range_share;  ///< Of its length, by which a ray that is cut may be longer or shorter.
};

/// Pixels from (u0, v0) to (u1, v1), both included.
struct PixelBlock {
  int u0;
  int v0;
  int u1;
  int v1;
};

/// A box in W, from the camera [m].
struct BoxOfCell {
  std::array<float, 3> centre;
  std::array<float, 3> half;
  std::array<float, 3> slack;  ///< By which its sides may be off.
  float depth;                 ///< All of it lies at this depth or farther.
};

/// Whether rays cross a box and end behind it.
struct Crossing {
  bool is_sure;      ///< At least one, whatever the slack.
  bool is_possible;  ///< Perhaps one does. Said of the pixels before a sure one only.
};

}  // namespace flyball
