// SPDX-License-Identifier: BSD-3-Clause
#include "whole_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr double nearest_m = 0.05;  // As ViewMargins: nearer, the image of a cube has no bounds.

/// Where a ray from the origin leaves a box, in units of its direction. Nothing if it misses it.
std::optional<double> leaves_at(const Vec3& direction, const Aabb& box) {
  const Eigen::Array3d a = box.min.array() / direction.array();
  const Eigen::Array3d b = box.max.array() / direction.array();
  const double enters = a.min(b).maxCoeff();
  const double leaves = a.max(b).minCoeff();
  return enters < leaves ? std::optional{leaves} : std::nullopt;
}

}  // namespace

WholeView::WholeView(const RangeImage& pixels, const Pose& X_WC, double range_m)
    : image_{pixels.image.value()},
      X_WC_{X_WC},
      range_m_{std::min({range_m, pixels.reach_m, image_.max_range_m})} {}

bool WholeView::sees_through(const Aabb& cube) const {
  const auto pixels = pixels_of(cube);
  if (!pixels) {
    return false;
  }
  const Intrinsics& camera = image_.camera;
  const Aabb from_camera{cube.min - X_WC_.translation(), cube.max - X_WC_.translation()};
  bool any = false;
  for (int v = pixels->v0; v <= pixels->v1; ++v) {
    for (int u = pixels->u0; u <= pixels->u1; ++u) {
      const Vec3 ray_C{(u - camera.centre_x_px) / camera.focal_px,
                       (v - camera.centre_y_px) / camera.focal_px, 1.0};
      const auto behind_m = leaves_at(X_WC_.linear() * ray_C, from_camera);
      const int pixel = v * camera.width_px + u;
      const float depth_m = image_.depth_m[static_cast<std::size_t>(pixel)];
      // The comparison is false for a depth that is not a number.
      if (behind_m && !(static_cast<double>(depth_m) >= *behind_m)) {
        return false;
      }
      any = any || behind_m.has_value();
    }
  }
  return any;
}

std::optional<WholeView::Pixels> WholeView::pixels_of(const Aabb& cube) const {
  const Intrinsics& camera = image_.camera;
  constexpr double far_px = std::numeric_limits<double>::infinity();
  Eigen::Array2d least{far_px, far_px};
  Eigen::Array2d most = -least;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 p_W{(corner & 1U) != 0 ? cube.max.x() : cube.min.x(),
                   (corner & 2U) != 0 ? cube.max.y() : cube.min.y(),
                   (corner & 4U) != 0 ? cube.max.z() : cube.min.z()};
    const Vec3 p_C = X_WC_.linear().transpose() * (p_W - X_WC_.translation());
    if (!(p_C.z() > nearest_m && p_C.norm() <= range_m_)) {
      return std::nullopt;
    }
    const Eigen::Array2d at{camera.centre_x_px + camera.focal_px * p_C.x() / p_C.z(),
                            camera.centre_y_px + camera.focal_px * p_C.y() / p_C.z()};
    least = least.min(at);
    most = most.max(at);
  }
  // Beyond the middle of the outermost pixels nothing was measured.
  const Eigen::Array2d last{camera.width_px - 1.0, camera.height_px - 1.0};
  if ((least < 0.0).any() || (most > last).any()) {
    return std::nullopt;
  }
  return Pixels{static_cast<int>(std::floor(least.x())), static_cast<int>(std::floor(least.y())),
                static_cast<int>(std::ceil(most.x())), static_cast<int>(std::ceil(most.y()))};
}

}  // namespace flyball
