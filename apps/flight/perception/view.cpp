// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/view.h"

#include <algorithm>
#include <cmath>

namespace flyball {

namespace {

// The renderer exposes for sunlight. In the shade a camera exposes longer, until the mean of the
// image is that of a grey card: a reflectance of 18 % is 118 in sRGB.
constexpr double metered_grey = 118.0;
constexpr double most_gain = 4.0;  // Chosen: two stops.

double luma_of(const std::uint8_t* rgb) {
  return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
}

std::vector<std::uint8_t> exposed_grey(const ColourImage& colour) {
  const std::size_t pixels = colour.rgb.size() / 3;
  double sum = 0.0;
  for (std::size_t i = 0; i < pixels; ++i) {
    sum += luma_of(&colour.rgb[3 * i]);
  }
  const double mean = sum / static_cast<double>(std::max<std::size_t>(pixels, 1));
  const double gain = std::clamp(metered_grey / std::max(mean, 1.0), 1.0, most_gain);
  std::vector<std::uint8_t> grey(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double bright = std::min(gain * luma_of(&colour.rgb[3 * i]), 255.0);
    grey[i] = static_cast<std::uint8_t>(std::lround(bright));
  }
  return grey;
}

}  // namespace

VisualFrame visual_frame(const View& view) {
  const DepthImage& depth = view.depth.image.value();
  const ColourImage& colour = view.colour.image.value();
  VisualFrame frame;
  frame.captured = view.depth.captured;
  frame.camera = {depth.camera.width_px,
                  depth.camera.height_px,
                  depth.camera.focal_px,
                  depth.camera.focal_px,
                  depth.camera.centre_x_px,
                  depth.camera.centre_y_px,
                  {}};
  frame.X_BC = view.X_BC;
  frame.depth_m = depth.depth_m;
  frame.grey = exposed_grey(colour);
  return frame;
}

}  // namespace flyball
