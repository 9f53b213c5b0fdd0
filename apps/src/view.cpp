// SPDX-License-Identifier: BSD-3-Clause
#include "view.h"

namespace flyball {

ColourCameraSpec colour_beside(const DepthCameraSpec& depth) {
  ColourCameraSpec colour;
  colour.width_px = depth.width_px;
  colour.height_px = depth.height_px;
  colour.horizontal_field_rad = depth.horizontal_field_rad;
  colour.rate_hz = depth.rate_hz;
  return colour;
}

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
  frame.grey.reserve(colour.rgb.size() / 3);
  for (std::size_t i = 0; i + 2 < colour.rgb.size(); i += 3) {
    const unsigned luma =
        299U * colour.rgb[i] + 587U * colour.rgb[i + 1] + 114U * colour.rgb[i + 2];
    frame.grey.push_back(static_cast<std::uint8_t>((luma + 500U) / 1000U));
  }
  return frame;
}

}  // namespace flyball
