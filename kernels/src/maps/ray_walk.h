// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The cells between two points: the same cells, in the same order, as OctoMap 1.9.7's
/// `computeRayKeys`, which is Amanatides & Woo 1987. Most of stock's
/// time goes into branches that no processor foresees, and into a list of keys; here the step is
/// computed, and a cell is handed on at once.

#include "maps/octomap_tree.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flyball {

class RayWalk {
 public:
  using Cell = std::array<int, 3>;  ///< Its keys.

  static Cell cell_of(const octomap::OcTree& lattice, const octomap::point3d& p) {
    const octomap::OcTreeKey key = lattice.coordToKey(p);
    return {key[0], key[1], key[2]};
  }

  /// @pre Both points lie inside the lattice.
  RayWalk(const octomap::OcTree& lattice, const octomap::point3d& from, const octomap::point3d& to)
      : start_{cell_of(lattice, from)}, end_{cell_of(lattice, to)} {
    octomap::point3d direction = to - from;
    length_ = static_cast<float>(direction.norm());
    if (!(length_ > 0.0F)) {  // A depth so small that floats lose it.
      end_ = start_;
      return;
    }
    direction /= length_;
    for (unsigned i = 0; i < 3; ++i) {
      aim(i, lattice, from(i), direction(i));
    }
  }

  /// Visits all cells but the one of the end point, and returns how many these are.
  template <class Visit>
  std::size_t visit_free(Visit&& visit) const {
    auto [x, y, z] = start_;
    auto [t_x, t_y, t_z] = t_max_;
    std::size_t visited = 0;
    // The first test ends walks that pass their end by rounding. A walk inside one cell is empty.
    for (double t = 0.0; t <= length_ && ((x ^ end_[0]) | (y ^ end_[1]) | (z ^ end_[2])) != 0;
         t = std::min({t_x, t_y, t_z})) {
      visit(Cell{x, y, z});
      ++visited;
      // `&`, not `&&`, which would be a branch.
      const bool along_x = (t_x < t_y) & (t_x < t_z);
      const bool along_y = (t_y <= t_x) & (t_y < t_z);
      const bool along_z = !(along_x | along_y);
      x += along_x ? step_[0] : 0;
      y += along_y ? step_[1] : 0;
      z += along_z ? step_[2] : 0;
      t_x += along_x ? t_delta_[0] : 0.0;
      t_y += along_y ? t_delta_[1] : 0.0;
      t_z += along_z ? t_delta_[2] : 0.0;
    }
    return visited;
  }

 private:
  // The mixture of float and double is stock's, and decides which cell a ray through a corner
  // takes.
  void aim(unsigned i, const octomap::OcTree& lattice, float from, float direction) {
    if (!(direction > 0.0F) && !(direction < 0.0F)) {
      return;
    }
    step_[i] = direction > 0.0F ? 1 : -1;
    double border = lattice.keyToCoord(static_cast<octomap::key_type>(start_[i]));
    border += static_cast<float>(step_[i] * lattice.getResolution() * 0.5);
    t_max_[i] = (border - from) / direction;
    t_delta_[i] = lattice.getResolution() / std::abs(static_cast<double>(direction));
  }

  static constexpr double never = std::numeric_limits<double>::max();

  Cell start_;
  Cell end_;
  float length_{};
  std::array<int, 3> step_{};
  std::array<double, 3> t_max_{never, never, never};
  std::array<double, 3> t_delta_{never, never, never};
};

}  // namespace flyball
