// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much unknown space a view would show.

#include "flyball/kernels/explorer.h"

#include "planning/state_grid.h"
#include <vector>

namespace flyball {

class ViewGain {
 public:
  /// @param threads  So many look at several views at once.
  /// The grid outlives it.
  ViewGain(const StateGrid& grid, const Aabb& volume_W, const ViewField& field, int threads = 1);

  /// Volume of the unknown cells of the volume that the camera would see, with the occupied ones in
  /// the way: Bircher et al. 2016 (doi:10.1109/ICRA.2016.7487281), eq. 3's Visible(M, xi).
  [[nodiscard]] double gain_m3(const Viewpoint& view);
  /// The same of each of several views, for any number of threads.
  [[nodiscard]] std::vector<double> gains_m3(const std::vector<Viewpoint>& views);
  /// Whether the centre of the cell lies in the pyramid.
  [[nodiscard]] bool is_in_field(const Viewpoint& view, const GridCell& cell) const;

  /// Looked at so far, and crossed by rays.
  [[nodiscard]] double cells() const { return cells_; }
  [[nodiscard]] double ray_cells() const { return ray_cells_; }

 private:
  /// In cells.
  struct Seen {
    double fresh{};      ///< Unknown so far.
    double looked_at{};  ///< Those that lie in the pyramid.
    double crossed{};    ///< By rays.
  };
  [[nodiscard]] Seen seen_from(const Viewpoint& view) const;
  /// Adds what is seen of a column, from `cell` up to the one at height `top`.
  void look_along(
      const Vec3& camera_W, const Vec3& heading, GridCell cell, int top, Seen& seen) const;

  const StateGrid& grid_;
  GridCell first_{};  ///< Of the volume.
  GridCell last_{};
  double range_m_;
  double tan_across_;
  double tan_up_;
  int threads_;
  double cells_{};
  double ray_cells_{};
};

}  // namespace flyball
