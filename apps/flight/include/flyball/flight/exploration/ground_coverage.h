// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which ground a downward camera has seen: footprints of pictures on a grid of cells.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/recorder.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace flyball {

/// Pose of a camera in the body's centre that looks straight down, with the top of its image ahead.
/// Like the depth camera's, its mount compensates roll and pitch.
[[nodiscard]] Pose downward_camera_pose(const Pose& X_WB);

/// The corners of the image on the level ground, in order around it.
using Footprint = std::array<Vec3, 4>;

/// Empty when the ray of a corner does not meet the ground.
[[nodiscard]] std::optional<Footprint> footprint_of(const Pose& X_WC,
                                                    const Intrinsics& camera,
                                                    double ground_z_m);

/// Fields of a row of the log: x0_m, y0_m, x1_m, ... of its corners.
[[nodiscard]] std::vector<Field> row_of(const Footprint& footprint);

/// Square cells over a rectangle of the ground. A cell is seen when its centre is in a footprint.
/// The ground counts as level, so what stands on it (a tree, a crop) hides nothing.
class GroundCoverage {
 public:
  GroundCoverage() = default;
  /// @pre The area has an extent in x and y, `cell_m > 0`.
  GroundCoverage(const Aabb& area_W, double cell_m);

  /// Pictures must come in the order in which they were taken.
  void add(const Footprint& footprint);
  [[nodiscard]] int pictures() const { return pictures_; }
  /// Share of the area that was seen.
  [[nodiscard]] double covered_percent() const;
  /// Share of the seen area that came into view again after it had been out of view: what
  /// neighbouring lanes share. Successive pictures of one pass do not count.
  [[nodiscard]] double overlap_percent() const;

 private:
  struct Cell {
    int last_picture{};  ///< The first picture is 1; 0: never seen.
    int visits{};
  };
  void look_along(int row, int first_column, int end_column, const Footprint& footprint);
  [[nodiscard]] double percent(int least_visits, std::size_t of) const;

  Aabb area_W_{};
  double cell_m_{1.0};
  int columns_{};
  int rows_{};
  int pictures_{};
  std::vector<Cell> cells_{};  ///< Row by row, from the least x and y.
};

}  // namespace flyball
