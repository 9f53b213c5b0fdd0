// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/colour_image.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

void set_pixel(ColourImage& image, int x, int y, const Rgb& colour) {
  if (x >= 0 && y >= 0 && x < image.camera.width_px && y < image.camera.height_px) {
    const int pixel = y * image.camera.width_px + x;
    std::copy(colour.begin(), colour.end(), &image.rgb[3 * static_cast<std::size_t>(pixel)]);
  }
}

}  // namespace

double overlap(const ImageBox& a, const ImageBox& b) {
  const double width =
      std::min(a.x_px + a.width_px, b.x_px + b.width_px) - std::max(a.x_px, b.x_px);
  const double height =
      std::min(a.y_px + a.height_px, b.y_px + b.height_px) - std::max(a.y_px, b.y_px);
  if (width <= 0.0 || height <= 0.0) {
    return 0.0;
  }
  const double common = width * height;
  return common / (a.area_px2() + b.area_px2() - common);
}

bool PixelRegion::covers(const PixelRegion& other) const {
  return other.is_empty() || (other.x_px >= x_px && other.y_px >= y_px &&
                              other.x_px + other.width_px <= x_px + width_px &&
                              other.y_px + other.height_px <= y_px + height_px);
}

PixelRegion whole(const Intrinsics& camera) {
  return {0, 0, camera.width_px, camera.height_px};
}

PixelRegion pixels_of(const ImageBox& box, const Intrinsics& camera) {
  // Clamped before the cast: a box may lie anywhere.
  const auto edge = [](double at_px, int size_px) {
    return static_cast<int>(std::clamp(at_px, 0.0, static_cast<double>(size_px)));
  };
  const int left = edge(std::floor(box.x_px), camera.width_px);
  const int top = edge(std::floor(box.y_px), camera.height_px);
  const int right = edge(std::ceil(box.x_px + box.width_px), camera.width_px);
  const int bottom = edge(std::ceil(box.y_px + box.height_px), camera.height_px);
  return {left, top, std::max(right - left, 0), std::max(bottom - top, 0)};
}

ColourPatch cut(const ColourImage& image, const PixelRegion& region) {
  ColourPatch patch{image.captured, image.sequence, image.camera, region, {}};
  if (region.is_empty()) {
    return patch;
  }
  const auto width = static_cast<std::size_t>(image.camera.width_px);
  const auto height = static_cast<std::size_t>(image.camera.height_px);
  FLYBALL_ASSERT(whole(image.camera).covers(region) && image.rgb.size() == 3 * width * height,
                 "%d x %d pixels from (%d, %d) of %zu bytes", region.width_px, region.height_px,
                 region.x_px, region.y_px, image.rgb.size());
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(region.width_px);
  patch.rgb.reserve(row_bytes * static_cast<std::size_t>(region.height_px));
  for (int y = region.y_px; y < region.y_px + region.height_px; ++y) {
    const std::uint8_t* row = image.rgb.data() + 3 * (static_cast<std::size_t>(y) * width +
                                                      static_cast<std::size_t>(region.x_px));
    patch.rgb.insert(patch.rgb.end(), row, row + row_bytes);
  }
  return patch;
}

void draw_box(ColourImage& image, const ImageBox& box, const Rgb& colour) {
  const int left = static_cast<int>(std::lround(box.x_px));
  const int top = static_cast<int>(std::lround(box.y_px));
  const int right = static_cast<int>(std::lround(box.x_px + box.width_px)) - 1;
  const int bottom = static_cast<int>(std::lround(box.y_px + box.height_px)) - 1;
  for (int inset = 0; inset < 2; ++inset) {
    for (int x = left; x <= right; ++x) {
      set_pixel(image, x, top + inset, colour);
      set_pixel(image, x, bottom - inset, colour);
    }
    for (int y = top; y <= bottom; ++y) {
      set_pixel(image, left + inset, y, colour);
      set_pixel(image, right - inset, y, colour);
    }
  }
}

}  // namespace flyball
