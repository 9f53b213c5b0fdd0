// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Depth scans of a room by closed-form ray intersection, and what they tell of each cell, found by
/// marching along every ray in small steps: slow, simple and independent of any map.

#include "flyball/runtime/messages.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace flyball {

/// A frame of a camera in a room of 11 m x 4.1 m x 2.75 m, with a block in it.
struct RoomScan {
  Pose X_WC{Pose::Identity()};
  DepthImage image{};
};

/// @param ahead_m  The camera's place along x, from where it is in frame 0.
inline RoomScan room_scan(int frame, double yaw_rad, int width_px = 64, double ahead_m = 0.0) {
  RoomScan scan;
  const int height_px = width_px * 9 / 16;
  Eigen::Matrix3d R_BC;
  R_BC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  scan.X_WC.linear() = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()}.toRotationMatrix() * R_BC;
  scan.X_WC.translation() = Vec3{-0.52 + 0.03 * frame + ahead_m, 0.013 * frame, 1.41};
  scan.image.sequence = static_cast<std::uint64_t>(frame);
  scan.image.captured = MissionTime{std::chrono::milliseconds{50} * frame};
  scan.image.camera = {width_px, height_px, 0.5 * width_px, 0.5 * (width_px - 1),
                       0.5 * (height_px - 1)};
  scan.image.max_range_m = 20.0;
  // No surface lies on a border of cells, where rounding decides.
  const Aabb room{{-3.03, -2.03, -0.02}, {8.04, 2.07, 2.73}};
  const Aabb block{{2.23, -1.12, -0.02}, {2.83, 0.12, 1.93}};
  const Vec3 from = scan.X_WC.translation();
  for (int i = 0; i < width_px * height_px; ++i) {
    const Vec3 ray_C{(i % width_px - scan.image.camera.centre_x_px) / scan.image.camera.focal_px,
                     (i / width_px - scan.image.camera.centre_y_px) / scan.image.camera.focal_px,
                     1.0};
    const Eigen::Array3d ray = (scan.X_WC.linear() * ray_C).array();
    const auto leave = [&](const Aabb& box) {
      return ((box.min - from).array() / ray).max((box.max - from).array() / ray).minCoeff();
    };
    const double enter =
        ((block.min - from).array() / ray).min((block.max - from).array() / ray).maxCoeff();
    const bool meets = enter > 0.0 && enter < leave(block);
    scan.image.depth_m.push_back(static_cast<float>(meets ? enter : leave(room)));
  }
  return scan;
}

/// Every pixel as a point; beyond `clear_beyond_m` as a ray without return.
inline PointCloud cloud_of(const DepthImage& image, double clear_beyond_m) {
  PointCloud cloud{image.captured, image.sequence, {}, {}, image.camera};
  for (std::size_t i = 0; i < image.depth_m.size(); ++i) {
    const int u = static_cast<int>(i) % image.camera.width_px;
    const int v = static_cast<int>(i) / image.camera.width_px;
    const Vec3 ray_C{(u - image.camera.centre_x_px) / image.camera.focal_px,
                     (v - image.camera.centre_y_px) / image.camera.focal_px, 1.0};
    const auto depth_m = static_cast<double>(image.depth_m[i]);
    if (depth_m * ray_C.norm() > clear_beyond_m) {
      cloud.clear_C.push_back((ray_C.normalized() * 1.001 * clear_beyond_m).cast<float>());
    } else {
      cloud.hits_C.push_back((ray_C * depth_m).cast<float>());
    }
  }
  return cloud;
}

/// How many frames crossed and hit each cell of a box.
class CellEvidence {
 public:
  CellEvidence(const Aabb& box_W, double cell_m) : cell_m_{cell_m} {
    for (int axis = 0; axis < 3; ++axis) {
      first_[axis] = index(box_W.min[axis]);
      count_[axis] = index(box_W.max[axis]) - first_[axis] + 1;
    }
    const auto cells = static_cast<std::size_t>(count_[0] * count_[1] * count_[2]);
    crossed_.assign(cells, 0);
    hit_.assign(cells, 0);
  }

  /// @param range_m  Points beyond it free their ray up to there and mark nothing.
  void add(const PointCloud& cloud_C, const Pose& X_WC, double range_m) {
    ++frames_;
    std::vector<std::uint8_t> seen(crossed_.size(), 0);
    for (const Eigen::Vector3f& p_C : cloud_C.hits_C) {
      march(X_WC, p_C.cast<double>(), range_m, true, seen);
    }
    for (const Eigen::Vector3f& p_C : cloud_C.clear_C) {
      march(X_WC, p_C.cast<double>(), range_m, false, seen);
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      crossed_[i] = static_cast<std::uint8_t>(crossed_[i] + (seen[i] & 1U));
      hit_[i] = static_cast<std::uint8_t>(hit_[i] + (seen[i] >> 1U));
    }
  }

  /// What is beyond doubt of a cell, whatever front-end a mapper has.
  struct Verdict {
    bool is_occupied{};  ///< Hit in every frame.
    bool is_free{};      ///< Crossed in every frame, as is all around it, and nothing near was hit.
    bool is_unseen{};    ///< No ray came near.
    bool has_no_wall{};  ///< Nothing near was ever hit.
  };

  /// @param visit  Called with the centre of each cell that has its neighbours in the box.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (int z = 1; z + 1 < count_[2]; ++z) {
      for (int y = 1; y + 1 < count_[1]; ++y) {
        for (int x = 1; x + 1 < count_[0]; ++x) {
          const Eigen::Vector3i cell = first_ + Eigen::Vector3i{x, y, z};
          visit(Vec3{(cell.cast<double>() + Vec3::Constant(0.5)) * cell_m_}, verdict(x, y, z));
        }
      }
    }
  }

 private:
  [[nodiscard]] int index(double x_m) const { return static_cast<int>(std::floor(x_m / cell_m_)); }
  [[nodiscard]] std::size_t at(int x, int y, int z) const {
    return static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x);
  }

  void march(const Pose& X_WC,
             const Vec3& p_C,
             double range_m,
             bool is_hit,
             std::vector<std::uint8_t>& seen) const {
    const double length_m = std::min(p_C.norm(), range_m);
    const bool marks = is_hit && p_C.norm() <= range_m;
    const Vec3 from = X_WC.translation();
    const Vec3 along = X_WC.linear() * p_C.normalized();
    for (double s_m = 0.0; s_m < length_m; s_m += 0.1 * cell_m_) {
      note(from + s_m * along, 1U, seen);
    }
    note(from + length_m * along, marks ? 2U : 1U, seen);
  }
  void note(const Vec3& p_W, std::uint8_t what, std::vector<std::uint8_t>& seen) const {
    const Eigen::Vector3i cell =
        Eigen::Vector3i{index(p_W.x()), index(p_W.y()), index(p_W.z())} - first_;
    if ((cell.array() >= 0).all() && (cell.array() < count_.array()).all()) {
      std::uint8_t& of = seen[at(cell.x(), cell.y(), cell.z())];
      of = static_cast<std::uint8_t>(of | what);
    }
  }

  [[nodiscard]] Verdict verdict(int x, int y, int z) const {
    Verdict verdict{hit_[at(x, y, z)] == frames_, true, true, true};
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t i = at(x + dx, y + dy, z + dz);
          verdict.has_no_wall = verdict.has_no_wall && hit_[i] == 0;
          verdict.is_unseen = verdict.is_unseen && hit_[i] == 0 && crossed_[i] == 0;
          verdict.is_free = verdict.is_free && crossed_[i] == frames_;
        }
      }
    }
    verdict.is_free = verdict.is_free && verdict.has_no_wall;
    return verdict;
  }

  double cell_m_;
  int frames_{};
  Eigen::Vector3i first_{Eigen::Vector3i::Zero()};
  Eigen::Vector3i count_{Eigen::Vector3i::Zero()};
  std::vector<std::uint8_t> crossed_{};
  std::vector<std::uint8_t> hit_{};
};

}  // namespace flyball
