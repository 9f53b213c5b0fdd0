// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Images as OpenCV has them. Only for .cpp files: its headers are heavy.

#include "flyball/runtime/colour_image.h"

#include <opencv2/imgproc.hpp>

namespace flyball {

/// The image's own bytes, in the order red, green, blue. @pre It outlives the result.
[[nodiscard]] inline cv::Mat borrowed(const ColourImage& image) {
  // OpenCV has no matrix of constant bytes; nobody writes to this one.
  return {image.camera.height_px, image.camera.width_px, CV_8UC3,
          const_cast<std::uint8_t*>(image.rgb.data())};  // NOLINT(*-const-cast)
}

/// The same of a patch.
[[nodiscard]] inline cv::Mat borrowed(const ColourPatch& patch) {
  return {patch.region.height_px, patch.region.width_px, CV_8UC3,
          const_cast<std::uint8_t*>(patch.rgb.data())};  // NOLINT(*-const-cast)
}

/// A copy of another size.
[[nodiscard]] inline cv::Mat resized(const cv::Mat& image, cv::Size size) {
  if (image.size() == size) {
    return image;
  }
  cv::Mat out;
  const bool smaller = size.width < image.cols;
  cv::resize(image, out, size, 0.0, 0.0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  return out;
}

[[nodiscard]] inline cv::Mat scaled(const cv::Mat& image, double scale) {
  return resized(
      image, {std::max(cvRound(image.cols * scale), 1), std::max(cvRound(image.rows * scale), 1)});
}

}  // namespace flyball
