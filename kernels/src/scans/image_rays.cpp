// SPDX-License-Identifier: BSD-3-Clause
// tested-in: depth_view
#include "image_rays.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

bool are_same(const Intrinsics& a, const Intrinsics& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.focal_px == b.focal_px &&
         a.centre_x_px == b.centre_x_px && a.centre_y_px == b.centre_y_px;
}

void measure_slopes(int pixels, double centre_px, double focal_px, std::vector<double>& slopes) {
  slopes.resize(static_cast<std::size_t>(pixels));
  for (int pixel = 0; pixel < pixels; ++pixel) {
    slopes[static_cast<std::size_t>(pixel)] = (pixel - centre_px) / focal_px;
  }
}

}  // namespace

void ImageRays::look(const DepthImage& image, double reach_m, double range_m) {
  image_ = &image;
  const bool is_new = !are_same(image.camera, camera_);
  if (is_new) {
    measure(image.camera);
  }
  const double nearer_m = std::min(reach_m, image.max_range_m);
  if (is_new || nearer_m != reach_m_) {
    reach_m_ = nearer_m;
    scale(reach_m_, reach_depths_m_);
    scale(beyond_reach * reach_m_, clear_depths_m_);
  }
  if (is_new || range_m != range_m_) {
    range_m_ = range_m;
    scale(range_m_, range_depths_m_);
  }
}

void ImageRays::measure(const Intrinsics& camera) {
  camera_ = camera;
  measure_slopes(camera.width_px, camera.centre_x_px, camera.focal_px, slope_x_);
  measure_slopes(camera.height_px, camera.centre_y_px, camera.focal_px, slope_y_);
  column_x_.assign(slope_x_.size() + lanes, 0.0F);
  std::transform(slope_x_.begin(), slope_x_.end(), column_x_.begin(),
                 [](double x) { return static_cast<float>(x); });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    column_W_[axis].assign(slope_x_.size() + lanes, 0.0F);
    row_W_[axis].resize(slope_y_.size());
  }
  lengths_.clear();
  for (const double y : slope_y_) {
    for (const double x : slope_x_) {
      lengths_.push_back(std::sqrt(x * x + (y * y + 1.0)));
    }
  }
}

/// The depths at which rays are that long, and room for a vector.
void ImageRays::scale(double length_m, std::vector<float>& depths_m) const {
  depths_m.assign(lengths_.size() + lanes, 0.0F);
  std::transform(lengths_.begin(), lengths_.end(), depths_m.begin(),
                 [&](double length) { return static_cast<float>(length_m / length); });
}

void ImageRays::lay_ends(const Pose& X_WC,
                         double range_doubt_m,
                         float* ends_m,
                         const InnerLoops& loops) {
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
  loops.lay_depths(depths_from(0), lengths_.size(), ends_m);
  probe_ = {{column_W_[0].data(), column_W_[1].data(), column_W_[2].data()},
            {row_W_[0].data(), row_W_[1].data(), row_W_[2].data()},
            ends_m,
            range_depths_m_.data(),
            width_px(),
            static_cast<float>(range_doubt_m / range_m_)};
}

PixelDepths ImageRays::depths_from(std::size_t pixel) const {
  return {image_->depth_m.data() + pixel, reach_depths_m_.data() + pixel,
          clear_depths_m_.data() + pixel, range_depths_m_.data() + pixel};
}

void ImageRays::points_from(
    int u, int v, PointBlock& points, PixelKinds& kinds, const InnerLoops& loops) const {
  const auto column = static_cast<std::size_t>(u);
  const auto row = static_cast<std::size_t>(v);
  PixelDepths depths = depths_from(row * slope_x_.size() + column);
  std::array<float, lanes> last_m{};
  if (column + lanes > slope_x_.size()) {
    std::copy_n(depths.depth_m, slope_x_.size() - column, last_m.begin());
    depths.depth_m = last_m.data();
  }
  loops.take_pixels(depths, column_x_.data() + column, static_cast<float>(slope_y_[row]), points,
                    kinds);
}

std::optional<PixelPoint> ImageRays::point(int pixel) const {
  const auto column = static_cast<std::size_t>(pixel % width_px());
  const auto row = static_cast<std::size_t>(pixel / width_px());
  const float depth_m = image_->depth_m[static_cast<std::size_t>(pixel)];
  return point_of_pixel(slope_x_[column], slope_y_[row], static_cast<double>(depth_m), reach_m_);
}

// A ray is the sum of a part by column and a part by row, and each of them grows or falls along the
// image, so one of the corners is farthest to each side.
bool ImageRays::any_towards(std::size_t axis, int side) const {
  const auto& columns = column_W_[axis];
  const auto& rows = row_W_[axis];
  const auto to_side = static_cast<float>(side);
  for (const float column : {columns.front(), columns[slope_x_.size() - 1]}) {
    for (const float row : {rows.front(), rows.back()}) {
      if (to_side * (column + row) > 0.0F) {
        return true;
      }
    }
  }
  return false;
}

Crossing ImageRays::cross(const BoxOfCell& box,
                          const PixelBlock& pixels,
                          const InnerLoops& loops) const {
  constexpr int stride = 8;  // of a large image, which is most often crossed by many
  if (pixels.v1 - pixels.v0 >= 2 * stride) {
    const Crossing sample = loops.cross_box(probe_, box, pixels, stride);
    if (sample.is_sure) {
      return sample;
    }
  }
  return loops.cross_box(probe_, box, pixels, 1);
}

void ImageRays::append_doubtful(const BoxOfCell& box,
                                const PixelBlock& pixels,
                                const InnerLoops& loops,
                                std::vector<int>& numbers) const {
  for (int v = pixels.v0; v <= pixels.v1; ++v) {
    if (!loops.cross_box(probe_, box, {pixels.u0, v, pixels.u1, v}, 1).is_possible) {
      continue;
    }
    for (int u = pixels.u0; u <= pixels.u1; ++u) {
      if (loops.cross_box(probe_, box, {u, v, u, v}, 1).is_possible) {
        numbers.push_back(v * width_px() + u);
      }
    }
  }
}

}  // namespace flyball
