// SPDX-License-Identifier: BSD-3-Clause
// tested-in: movers

#include "world/mover_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flyball {
namespace {

/// Columns and rows in which a box can be: first, and one past the last.
struct Window {
  int x{};
  int y{};
  int end_x{};
  int end_y{};
};

constexpr double lens_m = 0.05;  // A corner nearer than this to the lens' plane has no pixel.

int pixel(double at, int count) {
  return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count)));
}

/// Around the corners' pixels; the whole image when one lies beside or behind the lens.
Window window_of(const Aabb& box, const Pose& X_CW, const Intrinsics& camera) {
  Eigen::AlignedBox2d seen;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p_W{(corner & 1) != 0 ? box.max.x() : box.min.x(),
                   (corner & 2) != 0 ? box.max.y() : box.min.y(),
                   (corner & 4) != 0 ? box.max.z() : box.min.z()};
    const Vec3 p_C = X_CW * p_W;
    if (p_C.z() < lens_m) {
      return {0, 0, camera.width_px, camera.height_px};
    }
    seen.extend(Eigen::Vector2d{camera.centre_x_px + camera.focal_px * p_C.x() / p_C.z(),
                                camera.centre_y_px + camera.focal_px * p_C.y() / p_C.z()});
  }
  return {pixel(std::floor(seen.min().x()), camera.width_px),
          pixel(std::floor(seen.min().y()), camera.height_px),
          pixel(std::floor(seen.max().x()) + 1.0, camera.width_px),
          pixel(std::floor(seen.max().y()) + 1.0, camera.height_px)};
}

void draw_box(const Aabb& box, const Window& window, const Pose& X_WC, DepthImage& image) {
  const Intrinsics& camera = image.camera;
  for (int y = window.y; y < window.end_y; ++y) {
    float* row = image.depth_m.data() + static_cast<std::ptrdiff_t>(y) * camera.width_px;
    for (int x = window.x; x < window.end_x; ++x) {
      const Vec3 ray_C{(x - camera.centre_x_px) / camera.focal_px,
                       (y - camera.centre_y_px) / camera.focal_px, 1.0};
      const double depth_m = ray_enters(box, X_WC.translation(), X_WC.linear() * ray_C);
      const bool is_nearest = depth_m <= image.max_range_m && depth_m < static_cast<double>(row[x]);
      row[x] = is_nearest ? static_cast<float>(depth_m) : row[x];
    }
  }
}

}  // namespace

void draw(const std::vector<Mover>& movers, const Pose& X_WC, DepthImage& image) {
  const Pose X_CW = X_WC.inverse();
  for (const Mover& mover : movers) {
    const Aabb box = box_at(mover, image.captured);
    draw_box(box, window_of(box, X_CW, image.camera), X_WC, image);
  }
}

}  // namespace flyball
