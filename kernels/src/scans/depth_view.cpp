// SPDX-License-Identifier: BSD-3-Clause
#include "depth_view.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

/// As Eigen sums it on x86-64; on 64-bit Arm it would add x and y first, and round differently.
float squared_length(const Eigen::Vector3f& p) {
  return p.x() * p.x() + (p.y() * p.y() + p.z() * p.z());
}

}  // namespace

/// The image of the box of C around a cube, in pixels from the image's corner; perhaps beside it.
struct DepthView::Image {
  float u0;
  float v0;
  float u1;
  float v1;

  [[nodiscard]] bool is_beside(const PixelGrid& grid) const {
    return u1 < 0.0F || v1 < 0.0F || u0 >= static_cast<float>(grid.width_px) ||
           v0 >= static_cast<float>(grid.height_px);
  }
  [[nodiscard]] bool is_inside(const PixelGrid& grid) const {
    return u0 >= 0.0F && v0 >= 0.0F && u1 < static_cast<float>(grid.width_px) &&
           v1 < static_cast<float>(grid.height_px);
  }
  /// @pre It is not beside the image.
  [[nodiscard]] PixelBlock pixels(const PixelGrid& grid) const {
    const auto last = [](float at, int size) {
      return static_cast<int>(std::min(at, static_cast<float>(size - 1)));
    };
    return {static_cast<int>(std::max(u0, 0.0F)), static_cast<int>(std::max(v0, 0.0F)),
            last(u1, grid.width_px), last(v1, grid.height_px)};
  }
};

void DepthView::look(const PointCloud& cloud_C, const Pose& X_WC, double range_m) {
  depth_.build(cloud_C, range_m, loops_);
  aim(X_WC, range_m, {});
}

void DepthView::look(const Pose& X_WC, double range_m, ViewMargins margins) {
  depth_.finish(loops_);
  aim(X_WC, range_m, margins);
}

void DepthView::aim(const Pose& X_WC, double range_m, ViewMargins margins) {
  margins_ = margins;
  const Eigen::Matrix3d R_CW = X_WC.linear().transpose();
  measure_cubes(R_CW, range_m);
  aim_octants(R_CW);
  aim_probe(R_CW, range_m);
}

void DepthView::measure_cubes(const Eigen::Matrix3d& R_CW, double range_m) {
  for (std::size_t level = 0; level < extents_.size(); ++level) {
    const double half_m = 0.5 * finest_m_ * (1 << level) + margins_.slack_m;
    const double ball_m = std::sqrt(3.0) * half_m;
    const double near_m = std::max(range_m - ball_m, 0.0);
    const double far_m = range_m + ball_m;
    extents_[level] = {(R_CW.cwiseAbs() * Vec3::Constant(half_m)).cast<float>(),
                       static_cast<float>(near_m * near_m), static_cast<float>(far_m * far_m)};
  }
}

void DepthView::aim_octants(const Eigen::Matrix3d& R_CW) {
  for (std::size_t level = 1; level < octants_.size(); ++level) {
    OctantProbe& probe = octants_[level];
    const Extent& extent = extents_[level - 1];
    const double half_m = 0.5 * finest_m_ * (1 << (level - 1));
    for (unsigned octant = 0; octant < 8; ++octant) {
      const auto side = [&](unsigned axis) { return (octant >> axis & 1U) != 0 ? 1.0 : -1.0; };
      const Eigen::Vector3f offset_C =
          (R_CW * (half_m * Vec3{side(0), side(1), side(2)})).cast<float>();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        probe.offset_C[axis][octant] = offset_C[static_cast<int>(axis)];
      }
    }
    probe.half_C = {extent.half.x(), extent.half.y(), extent.half.z()};
    probe.nearest_m = static_cast<float>(margins_.nearest_m);
    probe.squared_near_m2 = extent.squared_near;
    probe.squared_far_m2 = extent.squared_far;
    probe.grid = depth_.grid();
    probe.scales = depth_.scales().data();
    probe.scales_count = static_cast<int>(depth_.scales().size());
  }
}

void DepthView::aim_probe(const Eigen::Matrix3d& R_CW, double range_m) {
  for (int cell = 0; cell < 64; ++cell) {
    const int row = cell / 4 % 4;
    const int layer = cell / 16;
    const Vec3 from_centre{cell % 4 - 1.5, row - 1.5, layer - 1.5};
    const Eigen::Vector3f offset_C = (R_CW * (finest_m_ * from_centre)).cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
      probe_.offset_C[static_cast<std::size_t>(axis)][static_cast<std::size_t>(cell)] =
          offset_C[axis];
    }
  }
  probe_.grid = depth_.grid();
  probe_.nearest_m = static_cast<float>(margins_.nearest_m);
  const Extent& cell = extents_[0];
  probe_.squared_range_m2 =
      margins_.probes_whole_cells ? cell.squared_near : static_cast<float>(range_m * range_m);
  probe_.half_cell_m =
      margins_.probes_whole_cells ? cell.half.z() : static_cast<float>(0.5 * finest_m_);
  probe_.depth_m = depth_.depth_m();
}

Aabb DepthView::box_of_view(const Pose& X_WC, double range_m, double margin_m) const {
  const PixelGrid& grid = probe_.grid;
  const Vec3 p_WC = X_WC.translation();
  Aabb box{p_WC, p_WC};
  for (const float u : {0.0F, static_cast<float>(grid.width_px)}) {
    for (const float v : {0.0F, static_cast<float>(grid.height_px)}) {
      const Vec3 corner_C{(u - grid.centre_u_px) / grid.focal_px,
                          (v - grid.centre_v_px) / grid.focal_px, 1.0};
      const Vec3 corner_W = X_WC * (range_m * corner_C);
      box.min = box.min.cwiseMin(corner_W);
      box.max = box.max.cwiseMax(corner_W);
    }
  }
  const Vec3 reach = Vec3::Constant(range_m + margin_m);
  const Vec3 margin = Vec3::Constant(margin_m);
  return {box.min.cwiseMax(p_WC - reach) - margin, box.max.cwiseMin(p_WC + reach) + margin};
}

// At its near end where it spreads, else at its far end.
DepthView::Image DepthView::image_of(const Eigen::Vector3f& centre_C, const Extent& extent) const {
  const PixelGrid& grid = probe_.grid;
  const float first_z = centre_C.z() - extent.half.z();
  constexpr float without_bounds = 1e9F;
  const float near_scale = first_z > probe_.nearest_m ? grid.focal_px / first_z : without_bounds;
  const float far_scale = grid.focal_px / (centre_C.z() + extent.half.z());
  const auto low_px = [&](float x) { return x * (x < 0.0F ? near_scale : far_scale); };
  const auto high_px = [&](float x) { return x * (x < 0.0F ? far_scale : near_scale); };
  return {low_px(centre_C.x() - extent.half.x()) + grid.centre_u_px,
          low_px(centre_C.y() - extent.half.y()) + grid.centre_v_px,
          high_px(centre_C.x() + extent.half.x()) + grid.centre_u_px,
          high_px(centre_C.y() + extent.half.y()) + grid.centre_v_px};
}

PixelBlock DepthView::pixels_around(const Eigen::Vector3f& centre_C, int level) const {
  const Image image = image_of(centre_C, extents_[static_cast<std::size_t>(level)]);
  return image.is_beside(probe_.grid) ? PixelBlock{0, 0, -1, -1} : image.pixels(probe_.grid);
}

bool DepthView::sees_through(const Eigen::Vector3f& centre_C, int level) const {
  constexpr int texels = 8;  // As wide as the block: what is looked at beside it is an eighth.
  const Extent& extent = extents_[static_cast<std::size_t>(level)];
  if (centre_C.z() - extent.half.z() <= probe_.nearest_m ||
      squared_length(centre_C) > extent.squared_near) {
    return false;
  }
  const Image image = image_of(centre_C, extent);
  return image.is_inside(probe_.grid) &&
         centre_C.z() + extent.half.z() <= depth_.span(image.pixels(probe_.grid), texels).least;
}

BlockVisibility DepthView::visibility_of(const Eigen::Vector3f& centre_C, int level) const {
  const Extent& extent = extents_[static_cast<std::size_t>(level)];
  const float first_z = centre_C.z() - extent.half.z();
  const float last_z = centre_C.z() + extent.half.z();
  const float squared_distance = squared_length(centre_C);
  if (last_z <= probe_.nearest_m || squared_distance > extent.squared_far) {
    return BlockVisibility::none;
  }
  if (first_z <= probe_.nearest_m) {
    return BlockVisibility::part;
  }
  const Image image = image_of(centre_C, extent);
  if (image.is_beside(probe_.grid)) {
    return BlockVisibility::none;
  }
  const DepthSpan behind = depth_.span(image.pixels(probe_.grid));
  if (first_z >= behind.most) {
    return BlockVisibility::none;
  }
  const bool is_whole = image.is_inside(probe_.grid) && squared_distance <= extent.squared_near &&
                        last_z <= behind.least;
  return is_whole ? BlockVisibility::whole : BlockVisibility::part;
}

}  // namespace flyball
