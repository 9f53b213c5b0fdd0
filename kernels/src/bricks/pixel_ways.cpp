// SPDX-License-Identifier: BSD-3-Clause
#include "pixel_ways.h"

#include <algorithm>
#include <cmath>

namespace flyball {

void PixelWays::aim(const DepthPyramid& depths, const Pose& X_WC, double range_m) {
  measure(depths.grid(), range_m);
  const Eigen::Matrix3d& R_WC = X_WC.linear();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<int>(axis);
    for (std::size_t u = 0; u < slope_x_.size(); ++u) {
      column_W_[axis][u] = static_cast<float>(R_WC(row, 0) * slope_x_[u]);
    }
    for (std::size_t v = 0; v < slope_y_.size(); ++v) {
      row_W_[axis][v] = static_cast<float>(R_WC(row, 1) * slope_y_[v] + R_WC(row, 2));
    }
  }
  probe_ = {{column_W_[0].data(), column_W_[1].data(), column_W_[2].data()},
            {row_W_[0].data(), row_W_[1].data(), row_W_[2].data()},
            depths.depth_m(),
            range_m_.data(),
            grid_.width_px};
}

/// What does not change while camera and range stay.
void PixelWays::measure(const PixelGrid& grid, double range_m) {
  if (grid == grid_ && range_m == measured_m_) {
    return;
  }
  grid_ = grid;
  measured_m_ = range_m;
  const auto slopes = [&](int pixels, float centre_px, std::vector<double>& slope) {
    slope.resize(static_cast<std::size_t>(pixels));
    for (std::size_t pixel = 0; pixel < slope.size(); ++pixel) {
      slope[pixel] = (static_cast<double>(pixel) + 0.5 - static_cast<double>(centre_px)) /
                     static_cast<double>(grid.focal_px);
    }
  };
  slopes(grid.width_px, grid.centre_u_px, slope_x_);
  slopes(grid.height_px, grid.centre_v_px, slope_y_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    column_W_[axis].resize(slope_x_.size() + lanes);
    row_W_[axis].resize(slope_y_.size());
  }
  range_m_.clear();
  for (const double y : slope_y_) {
    for (const double x : slope_x_) {
      range_m_.push_back(static_cast<float>(range_m / std::sqrt(1.0 + x * x + y * y)));
    }
  }
  range_m_.resize(range_m_.size() + lanes);
}

// Most cells that are crossed at all are crossed in the middle of their image.
Crossing PixelWays::cross(const BoxOfCell& box,
                          const PixelBlock& pixels,
                          const InnerLoops& loops) const {
  constexpr int few_rows = 3;
  constexpr int stride = 8;
  constexpr auto half_lanes = static_cast<int>(lanes / 2);
  const int rows = pixels.v1 - pixels.v0 + 1;
  if (rows > few_rows) {
    const int v = (pixels.v0 + pixels.v1) / 2;
    const int u = (pixels.u0 + pixels.u1) / 2;
    const PixelBlock middle{std::max(pixels.u0, u - half_lanes + 1), v,
                            std::min(pixels.u1, u + half_lanes), v};
    const Crossing there = loops.cross_box(probe_, box, middle, 1);
    if (there.is_sure) {
      return there;
    }
  }
  if (rows > 2 * stride) {
    const Crossing sample = loops.cross_box(probe_, box, pixels, stride);
    if (sample.is_sure) {
      return sample;
    }
  }
  return loops.cross_box(probe_, box, pixels, 1);
}

void PixelWays::append_doubtful(const BoxOfCell& box,
                                const PixelBlock& pixels,
                                const InnerLoops& loops,
                                std::vector<int>& numbers) const {
  for (int v = pixels.v0; v <= pixels.v1; ++v) {
    if (!loops.cross_box(probe_, box, {pixels.u0, v, pixels.u1, v}, 1).is_possible) {
      continue;
    }
    for (int u = pixels.u0; u <= pixels.u1; ++u) {
      if (loops.cross_box(probe_, box, {u, v, u, v}, 1).is_possible) {
        numbers.push_back(v * grid_.width_px + u);
      }
    }
  }
}

std::optional<std::size_t> PixelWays::find(int pixel,
                                           const std::vector<Eigen::Vector3f>& points_C,
                                           bool in_rows) const {
  const auto is_before = [this](const Eigen::Vector3f& p_C, int number) {
    return pixel_of(p_C) < number;
  };
  const auto is_it = [&](const Eigen::Vector3f& p_C) { return pixel_of(p_C) == pixel; };
  const auto first = points_C.begin();
  const auto last = points_C.end();
  const auto found =
      in_rows ? std::lower_bound(first, last, pixel, is_before) : std::find_if(first, last, is_it);
  if (found == last || !is_it(*found)) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - first);
}

/// The pixel in which it is seen; -1 beside the image.
int PixelWays::pixel_of(const Eigen::Vector3f& p_C) const {
  if (!(p_C.z() > 0.0F)) {
    return -1;
  }
  const float scale = grid_.focal_px / p_C.z();
  const float u = p_C.x() * scale + grid_.centre_u_px;
  const float v = p_C.y() * scale + grid_.centre_v_px;
  const bool is_inside = u >= 0.0F && v >= 0.0F && u < static_cast<float>(grid_.width_px) &&
                         v < static_cast<float>(grid_.height_px);
  return is_inside ? static_cast<int>(v) * grid_.width_px + static_cast<int>(u) : -1;
}

}  // namespace flyball
