// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/colour_image.h"

#include <algorithm>

namespace flyball {

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

}  // namespace flyball
