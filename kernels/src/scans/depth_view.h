// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a depth image says about a block of space.

#include "bricks/lattice.h"
#include "depth_pyramid.h"
#include "inner_loops.h"
#include <array>

namespace flyball {

/// How much of a block the camera sees through.
enum class BlockVisibility : std::uint8_t {
  none,   ///< Behind every surface, out of view or out of range.
  part,   ///< Perhaps some.
  whole,  ///< All: in view, in range, and nearer than the least depth behind it.
};

/// How a block is held against an image.
struct ViewMargins {
  double nearest_m{0.05};  ///< Nearer to the camera, a block's image has no bounds.
  double slack_m{0.0};     ///< Blocks are taken for wider by this to each side.
  /// The probe says yes only where the ray through the pixel at a cell's middle ends behind the
  /// whole cell.
  bool probes_whole_cells{false};
};

class DepthView {
 public:
  DepthView(double finest_m, const InnerLoops& loops) : finest_m_{finest_m}, loops_{loops} {}

  /// @pre The cloud has a camera.
  void look(const PointCloud& cloud_C, const Pose& X_WC, double range_m);
  /// The same in two steps, for callers that have the depths of an image: returns where they go.
  float* begin(const Intrinsics& camera) { return depth_.begin(camera); }
  void look(const Pose& X_WC, double range_m, ViewMargins margins);
  /// The box in W around the camera and all that it sees within the range, and a margin.
  [[nodiscard]] Aabb box_of_view(const Pose& X_WC, double range_m, double margin_m) const;
  /// A cube of level 1..5 around a point of C.
  [[nodiscard]] BlockVisibility visibility_of(const Eigen::Vector3f& centre_C, int level) const;
  /// `visibility_of` looks up to the cube's own width beside it, where the ground may come nearer
  /// than the cube. This looks closely, for several times as much work.
  [[nodiscard]] bool sees_through(const Eigen::Vector3f& centre_C, int level) const;
  /// Of the eight cubes in a cube of level 2..5.
  [[nodiscard]] OctantVisibility visibility_of_octants(const Eigen::Vector3f& centre_C,
                                                       int level) const {
    return loops_.see_octants(octants_[static_cast<std::size_t>(level)], centre_C.data());
  }
  [[nodiscard]] std::uint32_t whole_octants(const Eigen::Vector3f& centre_C, int level) const {
    return loops_.whole_octants(octants_[static_cast<std::size_t>(level)], centre_C.data());
  }
  /// From the centre of a block of `level` to that of its octant.
  [[nodiscard]] Eigen::Vector3f to_octant(int level, unsigned octant) const {
    const auto& offset_C = octants_[static_cast<std::size_t>(level)].offset_C;
    return {offset_C[0][octant], offset_C[1][octant], offset_C[2][octant]};
  }
  /// The pixels whose rays may cross a block: the whole side of the image where it has no bounds.
  /// @pre Some of it lies before the camera and in view.
  [[nodiscard]] PixelBlock pixels_around(const Eigen::Vector3f& centre_C, int level) const;
  /// No part of a block is nearer along the optical axis.
  [[nodiscard]] float nearest_depth_m(const Eigen::Vector3f& centre_C, int level) const {
    return centre_C.z() - extents_[static_cast<std::size_t>(level)].half.z();
  }
  /// For the single cells of a brick; see InnerLoops::seen_cells.
  [[nodiscard]] const CellProbe& probe() const { return probe_; }

 private:
  /// Of a cube of one level, in C.
  struct Extent {
    Eigen::Vector3f half;  ///< Of the box of C around it.
    float squared_near{};  ///< Centres nearer than this: the cube is in range as a whole.
    float squared_far{};   ///< Centres farther than this: it is out of range.
  };
  struct Image;
  [[nodiscard]] Image image_of(const Eigen::Vector3f& centre_C, const Extent& extent) const;
  void aim(const Pose& X_WC, double range_m, ViewMargins margins);
  void measure_cubes(const Eigen::Matrix3d& R_CW, double range_m);
  void aim_octants(const Eigen::Matrix3d& R_CW);
  void aim_probe(const Eigen::Matrix3d& R_CW, double range_m);

  double finest_m_;
  const InnerLoops& loops_;
  ViewMargins margins_{};
  DepthPyramid depth_{};
  std::array<Extent, chunk_level + 1> extents_{};
  std::array<OctantProbe, chunk_level + 1> octants_{};  ///< By the level of the outer cube.
  CellProbe probe_{};
};

}  // namespace flyball
