// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Stock OctoMap's masks and counts of a depth image, though hardly a ray is walked.
///
/// What a scan makes of a cell is a question about all rays at once: does any of them cross it and
/// end behind it? So space is held against the depth image block by block, as `PyramidScan` does
/// it, but nothing is left to the middle of a cell:
///   - behind every surface, out of view or out of range: no ray crosses the block;
///   - in view as a whole and before the nearest surface: rays cross all its cells, since each cell
///     holds a ball that is wider in the image than a pixel's diagonal;
///   - a single cell between the two: its pixels are asked, until one's ray crosses it.
/// Each answer keeps clear of its borders by a slack that is far more than what floats and
/// OctoMap's arithmetic may be off. Where the slack decides, and for rays that end on a border of
/// cells, the ray is walked in that arithmetic (`RayWalk`). So the masks are stock's, bit for bit,
/// and so are the counts: a ray that ends inside a cell has crossed as many cells as their keys are
/// apart.

#include "bricks/mask_window.h"
#include "depth_view.h"
#include "image_rays.h"
#include "maps/octomap_tree.h"
#include "maps/ray_walk.h"
#include "ray_scan.h"
#include <optional>

namespace flyball {

class ExactScan {
 public:
  explicit ExactScan(double cell_m, Simd simd = widest_simd());

  /// By whatever is faster: a walk of every ray where a cell at the range is hardly a pixel wide.
  ///
  /// @pre As RayScan's, and the frame has an image.
  /// @return Valid until the next call.
  const ScanMasks& compute(const PointCloudFrame& frame, const Pose& X_WC, double range_m);
  /// The same, block by block.
  ///
  /// @cost Points are made only where so many rays begin or end on a border that all are walked.
  const ScanMasks& descend(const PointCloudFrame& frame, const Pose& X_WC, double range_m);
  /// The same of points: every ray is walked.
  const ScanMasks& walk(const PointCloud& cloud_C, const Pose& X_WC, double range_m);
  /// Of the last scan: rays that were walked.
  [[nodiscard]] std::size_t walked_rays() const { return walked_; }

 private:
  struct Block {
    Eigen::Vector3f centre_C;
    Vec3 centre_W;      ///< From the camera.
    std::size_t place;  ///< Of its first brick in the window.
    int level;
  };
  struct StockRay {
    RayWalk walk;
    CellKey end;
    bool hits{};  ///< Its end is a hit.
  };

  void look(const RangeImage& pixels, const Pose& X_WC, double range_m);
  [[nodiscard]] std::array<int, 3> borders_near(const Vec3& p_W,
                                                const CellKey& cell,
                                                const Vec3& near_m) const;
  [[nodiscard]] bool knows_corner();
  [[nodiscard]] bool touches_eye(const Block& cell) const;
  void span_window(const Pose& X_WC);
  void aim_ends(const CellKey& own, double range_m);
  void settle();
  void settle_block(int u, int v);
  void free_seen(const Pose& X_CW);
  void free_cell(const CellKey& cell);
  void free_chunk(const CellKey& chunk, const Pose& X_CW);
  void free_inside(const Block& block);
  void free_brick(const Block& brick);
  [[nodiscard]] std::uint64_t crossed_cells(const Block& eighth,
                                            unsigned first_bit,
                                            std::uint64_t settled);
  [[nodiscard]] bool is_crossed(const Block& cell);
  [[nodiscard]] Block octant_of(const Block& block, unsigned octant, std::size_t place) const;
  [[nodiscard]] bool fills_pixels(const Block& block) const;
  void walk_doubtful();
  [[nodiscard]] std::optional<StockRay> stock_ray(int pixel);
  [[nodiscard]] std::size_t count_pixel(int pixel);
  void free_pixel(int pixel);

  Lattice lattice_;
  octomap::OcTree stock_lattice_;  ///< Empty: it only lends its arithmetic.
  const InnerLoops& loops_;
  RayScan rays_;
  DepthView view_;
  ImageRays image_rays_{};
  MaskWindow window_{};
  RayFrame frame_{};
  Vec3 camera_W_{Vec3::Zero()};  ///< As the rays begin: rounded to floats.
  std::array<int, 3> beside_{};  ///< The camera is as good as on these borders of its cell.
  double corner_m_{};            ///< So near to them, at most.
  PoseRows rows_{};
  EndFrame ends_{};
  BoxOfCell box_{};  ///< The cell in question.
  Scan scan_{};      ///< For the walk of all rays.
  ScanMasks masks_{};
  CellKey first_chunk_{};
  CellKey last_chunk_{};
  std::vector<int> doubtful_px_{};
  double ball_reach_m_{};   ///< Up to there a cell is wider in the image than a pixel.
  std::size_t measured_{};  ///< Pixels that are rays.
  std::size_t traversals_{};
  std::size_t walked_{};
};

}  // namespace flyball
