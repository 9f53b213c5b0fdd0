// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The coarse-to-fine front-end: space is held against the depth image block by block.
///
/// From chunks down, a block that lies behind every surface, out of view or out of range is left;
/// one that is seen through as a whole is freed as a whole; any other is cut in eight. So the work
/// goes where the surfaces are. The knob is the level of the smallest block: above 0 only what is
/// wholly visible is freed; at 0 a single cell is free when the pixel at its centre sees past it.
/// Hits always go into the finest cells.

#include "bricks/mask_window.h"
#include "depth_view.h"

namespace flyball {

class PyramidScan {
 public:
  explicit PyramidScan(double finest_m, Simd simd = widest_simd());

  /// From now on, where a block is wider than a fourth of the view's height at its depth, the next
  /// finer one that is not takes its place.
  ///
  /// Near the camera a coarse block never lies wholly in view, and a vehicle would stand before a
  /// gap between its own place and the first free block. This narrows the gap; it does not close it
  /// at every height of the camera over the lattice.
  void refine_near_camera() { refines_near_ = true; }

  /// @param floor_level  Level of the smallest block that is freed: 0..3.
  /// @pre The cloud has a camera, and what lies within `range_m` of it lies inside the lattice.
  /// @return Valid until the next call. No ray is walked: `traversals` is 0.
  /// @cost Nothing is allocated once the window and the image fit.
  const ScanMasks& compute(const PointCloud& cloud_C,
                           const Pose& X_WC,
                           double range_m,
                           int floor_level);

 private:
  struct Block {
    Eigen::Vector3f centre_C;
    std::size_t place;  ///< Of its first brick in the window.
    int level;
  };
  void span_window(const Pose& X_WC, double range_m);
  void mark_hits(const PointCloud& cloud_C, const Pose& X_WC, double range_m);
  void mark_hits_of(std::size_t brick, std::uint64_t hit);
  void mark_origin(const Vec3& p_WC);
  void free_chunk(const CellKey& chunk, const Pose& X_CW);
  [[nodiscard]] int floor_at(float depth_m) const;
  void free_inside(const Block& block);
  void free_closely(const Block& block);
  void free_octants(const Block& block);
  void free_eighths(const Block& brick);
  void free_cells(const Block& brick);

  Lattice lattice_;
  const InnerLoops& loops_;
  DepthView view_;
  MaskWindow window_{};
  ScanMasks masks_{};
  CellKey first_chunk_{};
  CellKey last_chunk_{};
  int floor_level_{};
  bool refines_near_{};
  double view_share_{};  ///< The view's height over its depth.
};

}  // namespace flyball
