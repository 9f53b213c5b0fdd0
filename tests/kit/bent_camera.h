// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The textured camera behind a lens that bends directions.

#include "circle_flight.h"
#include "textured_camera.h"
#include <limits>

namespace flyball::kit {

/// The formulas themselves: OpenCV is what is tested with them.
inline Eigen::Vector2d bent_pixel(const CameraModel& camera, const Eigen::Vector2d& ray) {
  const auto& k = camera.distortion;
  const double r2 = ray.squaredNorm();
  Eigen::Vector2d bent = ray;
  if (camera.distortion_model == DistortionModel::equidistant) {
    const double r = std::sqrt(r2);
    const double t = std::atan(r);
    const double t2 = t * t;
    const double by = t * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
    bent *= r > 1e-9 ? by / r : 1.0;
  } else {
    const double xy = ray.x() * ray.y();
    bent *= 1.0 + r2 * (k[0] + r2 * k[1]);
    bent.x() += 2.0 * k[2] * xy + k[3] * (r2 + 2.0 * ray.x() * ray.x());
    bent.y() += k[2] * (r2 + 2.0 * ray.y() * ray.y()) + 2.0 * k[3] * xy;
  }
  return {camera.focal_x_px * bent.x() + camera.centre_x_px,
          camera.focal_y_px * bent.y() + camera.centre_y_px};
}

/// Looks at a straight picture of twice the size, 105 degrees wide; what lies beyond is black.
class BentCamera {
 public:
  BentCamera(const World& world, const CameraModel& lens, std::uint64_t seed)
      : lens_{lens}, straight_{world, wide(lens), seed} {}

  [[nodiscard]] VisualFrame capture(const Pose& X_WC,
                                    MissionTime now,
                                    std::uint64_t sequence) const {
    const VisualFrame wide = straight_.capture(X_WC, now, sequence);
    VisualFrame frame;
    frame.captured = now;
    frame.camera = lens_;
    for (int y = 0; y < lens_.height_px; ++y) {
      for (int x = 0; x < lens_.width_px; ++x) {
        const Eigen::Vector2d at = source(wide.camera, {x, y});
        frame.grey.push_back(grey(wide, at));
        frame.depth_m.push_back(depth(wide, at));
      }
    }
    return frame;
  }

 private:
  static DepthCameraSpec wide(const CameraModel& lens) {
    DepthCameraSpec spec;
    spec.width_px = 2 * lens.width_px;
    spec.height_px = 2 * lens.height_px;
    spec.horizontal_field_rad = 1.83;
    return spec;
  }

  /// Newton's method by differences on the formula.
  [[nodiscard]] Eigen::Vector2d source(const CameraModel& straight,
                                       const Eigen::Vector2d& pixel) const {
    constexpr double step = 1e-6;
    Eigen::Vector2d ray = Eigen::Vector2d::Zero();
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector2d at = bent_pixel(lens_, ray);
      Eigen::Matrix2d slope;
      slope.col(0) = (bent_pixel(lens_, ray + Eigen::Vector2d{step, 0.0}) - at) / step;
      slope.col(1) = (bent_pixel(lens_, ray + Eigen::Vector2d{0.0, step}) - at) / step;
      ray += slope.inverse() * (pixel - at);
    }
    return {straight.focal_x_px * ray.x() + straight.centre_x_px,
            straight.focal_y_px * ray.y() + straight.centre_y_px};
  }

  [[nodiscard]] static bool has(const VisualFrame& wide, const Eigen::Vector2d& at) {
    return at.x() >= 0.0 && at.y() >= 0.0 && at.x() < wide.camera.width_px - 1.0 &&
           at.y() < wide.camera.height_px - 1.0;
  }
  [[nodiscard]] static std::size_t index(const VisualFrame& wide, double x, double y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(wide.camera.width_px) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] static std::uint8_t grey(const VisualFrame& wide, const Eigen::Vector2d& at) {
    if (!has(wide, at)) {
      return 0;
    }
    const double u = at.x() - std::floor(at.x());
    const double v = at.y() - std::floor(at.y());
    const auto value = [&](double x, double y) {
      return static_cast<double>(wide.grey[index(wide, at.x() + x, at.y() + y)]);
    };
    return static_cast<std::uint8_t>((1.0 - v) * ((1.0 - u) * value(0, 0) + u * value(1, 0)) +
                                     v * ((1.0 - u) * value(0, 1) + u * value(1, 1)));
  }
  [[nodiscard]] static float depth(const VisualFrame& wide, const Eigen::Vector2d& at) {
    return has(wide, at) ? wide.depth_m[index(wide, at.x() + 0.5, at.y() + 0.5)]
                         : std::numeric_limits<float>::infinity();
  }

  CameraModel lens_;
  TexturedCamera straight_;
};

}  // namespace flyball::kit
