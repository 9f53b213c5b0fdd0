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

#include "bricks/mark_window.h"
#include "inner_loops.h"
#include "maps/octomap_tree.h"
#include "scan.h"
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
  void cut_rays(const Scan& scan);
  void span_window();
  void walk_block(std::size_t block);
  void walk_as_stock(const PointBlock& ends, std::size_t lane);
  void mark_hits(std::size_t measured_hits);
  [[nodiscard]] std::size_t rays_in(std::size_t block) const;

  octomap::OcTree lattice_;  ///< Empty: it only lends its arithmetic.
  Match match_;
  const InnerLoops& loops_;

  RayFrame frame_{};
  std::size_t rays_{};
  std::vector<PointBlock> ends_{};  ///< First those that were measured as hits.
  MarkWindow window_{};
  WindowAxes axes_{};
  std::vector<std::uint32_t> places_{};  ///< Of sixteen rays that are being walked.
  ScanMasks masks_{};
  std::size_t traversals_{};
  std::size_t ambiguous_{};
};

}  // namespace flyball
