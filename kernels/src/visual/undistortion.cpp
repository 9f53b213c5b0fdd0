// SPDX-License-Identifier: BSD-3-Clause
#include "visual/undistortion.h"

#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>

namespace flyball {
namespace {

constexpr float widest_ray = 5.67F;  // Tangent of 80 degrees.
constexpr double reach_px = 0.5;     // Bent again, a direction must come back this close.

cv::Matx33d matrix_of(const CameraModel& camera) {
  return {
      camera.focal_x_px, 0, camera.centre_x_px, 0, camera.focal_y_px, camera.centre_y_px, 0, 0, 1};
}

cv::Vec4d coefficients(const CameraModel& camera) {
  const auto& d = camera.distortion;
  return {d[0], d[1], d[2], d[3]};
}

std::vector<cv::Point2f> unbent(const CameraModel& camera, const std::vector<cv::Point2f>& pixels) {
  std::vector<cv::Point2f> rays;
  if (camera.distortion_model == DistortionModel::equidistant) {
    cv::fisheye::undistortPoints(pixels, rays, matrix_of(camera), coefficients(camera));
  } else {
    cv::undistortPoints(pixels, rays, matrix_of(camera), coefficients(camera));
  }
  return rays;
}

std::vector<cv::Point2f> bent(const CameraModel& camera, const std::vector<cv::Point2f>& rays) {
  std::vector<cv::Point2f> pixels;
  if (camera.distortion_model == DistortionModel::equidistant) {
    cv::fisheye::distortPoints(rays, pixels, matrix_of(camera), coefficients(camera));
    return pixels;
  }
  std::vector<cv::Point3f> directions;
  directions.reserve(rays.size());
  for (const cv::Point2f& ray : rays) {
    directions.emplace_back(ray.x, ray.y, 1.0F);
  }
  const cv::Vec3d zero{};
  cv::projectPoints(directions, zero, zero, matrix_of(camera), coefficients(camera), pixels);
  return pixels;
}

std::vector<cv::Point2f> to_cv(const std::vector<Eigen::Vector2f>& pixels) {
  std::vector<cv::Point2f> points;
  points.reserve(pixels.size());
  for (const Eigen::Vector2f& pixel : pixels) {
    points.emplace_back(pixel.x(), pixel.y());
  }
  return points;
}

}  // namespace

// The equidistant formula bends even with coefficients of zero.
bool is_distorted(const CameraModel& camera) {
  const auto& d = camera.distortion;
  return camera.distortion_model == DistortionModel::equidistant ||
         std::any_of(d.begin(), d.end(), [](double k) { return k != 0.0; });
}

std::vector<std::optional<Eigen::Vector2f>> straight_rays(
    const CameraModel& camera, const std::vector<Eigen::Vector2f>& pixels) {
  if (pixels.empty()) {
    return {};
  }
  const std::vector<cv::Point2f> seen = to_cv(pixels);
  const std::vector<cv::Point2f> rays = unbent(camera, seen);
  // OpenCV inverts both formulas by iteration, and does not say where it has not converged.
  const std::vector<cv::Point2f> again = is_distorted(camera) ? bent(camera, rays) : seen;
  std::vector<std::optional<Eigen::Vector2f>> found(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (std::hypot(rays[i].x, rays[i].y) < widest_ray && cv::norm(again[i] - seen[i]) < reach_px) {
      found[i] = Eigen::Vector2f{rays[i].x, rays[i].y};
    }
  }
  return found;
}

std::vector<std::optional<Eigen::Vector2f>> straightened(
    const CameraModel& camera, const std::vector<Eigen::Vector2f>& pixels) {
  if (!is_distorted(camera)) {
    return {pixels.begin(), pixels.end()};
  }
  std::vector<std::optional<Eigen::Vector2f>> places = straight_rays(camera, pixels);
  for (auto& place : places) {
    if (place) {
      place =
          Eigen::Vector2f{static_cast<float>(camera.focal_x_px * static_cast<double>(place->x()) +
                                             camera.centre_x_px),
                          static_cast<float>(camera.focal_y_px * static_cast<double>(place->y()) +
                                             camera.centre_y_px)};
    }
  }
  return places;
}

}  // namespace flyball
