// SPDX-License-Identifier: BSD-3-Clause
#include "visual/detection_boxes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace flyball {

Status check_detector_input(const ColourImage& image, double scale) {
  const auto [width, height] = std::tuple{image.camera.width_px, image.camera.height_px};
  const std::size_t bytes = image.rgb.size();
  if (width < 1 || height < 1 ||
      bytes != 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    return Error{ErrorCode::invalid_input, "an image of " + std::to_string(bytes) +
                                               " bytes is none of " + std::to_string(width) +
                                               " x " + std::to_string(height) + " pixels"};
  }
  if (!(scale > 0.0 && scale <= 8.0)) {
    return Error{ErrorCode::invalid_input,
                 "detector.scale = " + std::to_string(scale) + " must be above 0 and at most 8"};
  }
  return Done{};
}

std::vector<Detection> keep_best(std::vector<Detection> found, double most_overlap) {
  // What a network with damaged weights says is no number, and has no place in an order.
  const auto is_no_number = [](const Detection& one) {
    return !std::isfinite(one.score + one.box.x_px + one.box.y_px + one.box.width_px +
                          one.box.height_px);
  };
  found.erase(std::remove_if(found.begin(), found.end(), is_no_number), found.end());
  std::sort(found.begin(), found.end(), [](const Detection& a, const Detection& b) {
    return std::tuple{-a.score, a.box.y_px, a.box.x_px, a.box.width_px} <
           std::tuple{-b.score, b.box.y_px, b.box.x_px, b.box.width_px};
  });
  std::vector<Detection> kept;
  for (const Detection& next : found) {
    if (std::none_of(kept.begin(), kept.end(), [&](const Detection& surer) {
          return overlap(surer.box, next.box) > most_overlap;
        })) {
      kept.push_back(next);
    }
  }
  return kept;
}

}  // namespace flyball
