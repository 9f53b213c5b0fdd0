// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Pictures of a colour camera, cut-outs of them, and boxes in them.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/time.h"

#include <array>
#include <cstdint>
#include <vector>

namespace flyball {

/// One picture: red, green, blue, 8 bits each, row by row.
struct ColourImage {
  MissionTime captured{};
  std::uint64_t sequence{};
  Intrinsics camera{};
  std::vector<std::uint8_t> rgb{};
};

/// Rectangle in an image; the pixel (u, v) covers [u, u + 1) x [v, v + 1).
struct ImageBox {
  double x_px{};  ///< Left edge.
  double y_px{};  ///< Upper edge.
  double width_px{};
  double height_px{};

  [[nodiscard]] double centre_x_px() const { return x_px + 0.5 * width_px; }
  [[nodiscard]] double centre_y_px() const { return y_px + 0.5 * height_px; }
  [[nodiscard]] double area_px2() const { return width_px * height_px; }
};

/// Whole pixels of an image: `width_px` columns from `x_px` on, `height_px` rows from `y_px` on.
struct PixelRegion {
  int x_px{};
  int y_px{};
  int width_px{};
  int height_px{};

  [[nodiscard]] bool is_empty() const { return width_px <= 0 || height_px <= 0; }
  /// Also true of an empty one.
  [[nodiscard]] bool covers(const PixelRegion& other) const;
};

/// A cut-out of a picture. It holds the pixels of its region and no others, so that nobody can read
/// what was not asked for.
struct ColourPatch {
  MissionTime captured{};
  std::uint64_t sequence{};
  Intrinsics camera{};              ///< Of the whole picture.
  PixelRegion region{};             ///< Inside the picture; may be empty.
  std::vector<std::uint8_t> rgb{};  ///< Of the region, as in `ColourImage`.
};

[[nodiscard]] PixelRegion whole(const Intrinsics& camera);
/// The pixels that the box touches, as far as the image has them.
[[nodiscard]] PixelRegion pixels_of(const ImageBox& box, const Intrinsics& camera);
/// @pre The image has its pixels, and the region lies inside it.
[[nodiscard]] ColourPatch cut(const ColourImage& image, const PixelRegion& region);

/// Intersection over union, 0..1; zero for boxes without area.
[[nodiscard]] double overlap(const ImageBox& a, const ImageBox& b);

using Rgb = std::array<std::uint8_t, 3>;

/// Draws the box's edges, two pixels wide; what is outside of the image is left out.
void draw_box(ColourImage& image, const ImageBox& box, const Rgb& colour);

}  // namespace flyball
