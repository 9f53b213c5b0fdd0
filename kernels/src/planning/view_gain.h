// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much unknown space a view would show.

#include "flyball/kernels/explorer.h"

#include "planning/state_grid.h"
#include <cmath>
#include <vector>

namespace flyball {

/// The directions that a camera sees, in the level frame of the body's heading: forward, left, up.
class Pyramid {
 public:
  explicit Pyramid(const ViewField& field);
  /// The camera, where the body is at the view.
  [[nodiscard]] Vec3 apex_W(const Viewpoint& view) const;
  [[nodiscard]] bool holds(double forward_m, double left_m, double up_m) const {
    const double depth_m = cos_ * forward_m - sin_ * up_m;
    return depth_m > 0.0 && std::abs(left_m) <= tan_across_ * depth_m &&
           to_edge_m(forward_m, up_m) >= 0.0;
  }
  /// From there to the upper or the lower edge, whichever is nearer; negative outside.
  [[nodiscard]] double to_edge_m(double forward_m, double up_m) const {
    return tan_up_ * (cos_ * forward_m - sin_ * up_m) - std::abs(sin_ * forward_m + cos_ * up_m);
  }
  /// Whether it holds nothing at this bearing, at any height; a level one knows without asking.
  [[nodiscard]] bool leaves_out(double forward_m, double left_m) const {
    return sin_ == 0.0 && (forward_m <= 0.0 || std::abs(left_m) > tan_across_ * forward_m);
  }

 private:
  double tan_across_;
  double tan_up_;
  double cos_;
  double sin_;
  double forward_m_;
  double up_m_;
};

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
  Pyramid pyramid_;
  int threads_;
  double cells_{};
  double ray_cells_{};
};

}  // namespace flyball
