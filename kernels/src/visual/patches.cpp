// SPDX-License-Identifier: BSD-3-Clause
#include "visual/patches.h"

#include <opencv2/video/tracking.hpp>

namespace flyball {
namespace {

// Larger ones see slanted surfaces grow: at 21 px the drift is twice that at 9 px.
constexpr int window_px = 9;
constexpr int coarser_levels = 1;
constexpr double farthest_px = 3.0;

cv::Mat image_of(const std::vector<std::uint8_t>& grey, const CameraModel& camera) {
  return {camera.height_px, camera.width_px, CV_8UC1,
          const_cast<std::uint8_t*>(grey.data())};  // NOLINT: only read
}

cv::Point2f point_of(const Eigen::Vector2d& at) {
  return {static_cast<float>(at.x()), static_cast<float>(at.y())};
}

}  // namespace

std::vector<std::optional<Eigen::Vector2d>> follow_patches(const std::vector<std::uint8_t>& before,
                                                           const std::vector<std::uint8_t>& now,
                                                           const CameraModel& camera,
                                                           const std::vector<PatchPair>& pairs) {
  std::vector<std::optional<Eigen::Vector2d>> places(pairs.size());
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
  for (const PatchPair& pair : pairs) {
    from.push_back(point_of(pair.before));
    to.push_back(point_of(pair.now));
  }
  if (pairs.empty()) {
    return places;
  }
  std::vector<std::uint8_t> found;
  std::vector<float> error;
  try {
    const cv::TermCriteria enough{cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 20, 0.01};
    cv::calcOpticalFlowPyrLK(image_of(before, camera), image_of(now, camera), from, to, found,
                             error, cv::Size{window_px, window_px}, coarser_levels, enough,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
  } catch (const cv::Exception&) {
    return places;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector2d place{static_cast<double>(to[i].x), static_cast<double>(to[i].y)};
    if (found[i] != 0 && (place - pairs[i].now).norm() < farthest_px) {
      places[i] = place;
    }
  }
  return places;
}

}  // namespace flyball
