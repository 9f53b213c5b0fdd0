// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The ray front-ends: every ray of a scan frees the cells that it crosses and hits the one where
/// it ends, as OctoMap 1.9.7's `insertPointCloud` does it.
///
/// Sixteen rays walk at a time, in integers: the times at which a ray crosses the borders of cells
/// (Amanatides & Woo 1987) are rounded to 2^-30 of the range. They order the crossings as OctoMap's
/// doubles do unless two crossings are nearer to each other than the rounding, which is checked for
/// every ray. `Match::stock` walks those rays again in OctoMap's own arithmetic, so that its masks
/// are stock's, bit for bit; `Match::close` takes either order. A ray whose end lies as near to a
/// border is walked in OctoMap's arithmetic in both.

#include "../scan_update.h"
#include "inner_loops.h"
#include "mark_window.h"
#include "scan_masks.h"

namespace flyball {

class RayScan {
 public:
  enum class Match : std::uint8_t { stock, close };

  RayScan(double cell_m, Match match, Simd simd = widest_simd());

  /// @pre Every coordinate within the range of the origin lies inside the lattice, and the range is
  ///      at most 250 cells.
  /// @return Valid until the next call. `traversals` and `updates` are stock's for `Match::stock`.
  /// @cost One byte per cell of the box around the rays; nothing is allocated once it fits.
  const ScanMasks& compute(const Scan& scan);
  /// Of the last scan: rays that were walked in OctoMap's arithmetic.
  [[nodiscard]] std::size_t ambiguous_rays() const { return ambiguous_; }

  static constexpr double most_cells_per_ray = 250.0;

 private:
  struct Ray {
    octomap::point3d end_W;
    CellKey end;
    bool is_hit;
  };
  void cut_rays(const Scan& scan);
  void span_window();
  void prepare_lanes(const Scan& scan);
  void add_to_block(const Ray& ray);
  [[nodiscard]] bool aim(const Ray& ray, std::size_t lane);
  void walk_block();
  void walk_as_stock(const octomap::point3d& end_W);

  octomap::OcTree lattice_;  ///< Empty: it only lends its arithmetic.
  double cell_m_;
  Match match_;
  const InnerLoops& loops_;

  octomap::point3d origin_W_{};
  CellKey origin_{};
  std::vector<Ray> rays_{};
  MarkWindow window_{};
  ScanMasks masks_{};
  std::size_t traversals_{};
  std::size_t ambiguous_{};

  // One block of rays on its way.
  RayBlock block_{};
  WindowAxes axes_{};
  std::array<std::array<double, 2>, 3> border_m_{};  ///< From the origin to its cell's borders.
  double units_per_m_{};
  std::size_t lanes_{};
  std::array<int, RayBlock::lanes> steps_{};
  std::array<const Ray*, RayBlock::lanes> ray_of_{};
  std::vector<std::uint32_t> places_{};
};

}  // namespace flyball
