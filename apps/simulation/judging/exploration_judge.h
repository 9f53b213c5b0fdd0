// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Holds a map against the true world. It judges an exploration; it never steers one.

#include "flyball/flight/brief.h"
#include "flyball/kernels/mapper.h"
#include "flyball/sim/observable_space.h"
#include "flyball/sim/world.h"

#include <vector>

namespace flyball {

/// How well the occupied cells of a map fit the surfaces that could be seen, one cell of tolerance.
struct MapAgreement {
  double precision{};  ///< Share of the map's occupied volume that lies at a surface.
  double recall{};     ///< Share of the surfaces at which the map has something occupied.
};

class ExplorationJudge {
 public:
  explicit ExplorationJudge(ObservableSpace space);

  /// Share of the cells which can be seen that the map knows, as free or occupied.
  /// @cost In proportion to what is still unknown: what was known once is not asked for again.
  [[nodiscard]] double coverage_percent(const OccupancyView& map);
  /// Within the box that the surfaces span, and a cell around it.
  [[nodiscard]] MapAgreement agreement(const Mapper& mapper) const;

 private:
  ObservableSpace space_;
  std::vector<GridCell> unknown_{};
};

/// How well a map of the site's volume shows what can be seen of it from free space that the body
/// can reach.
[[nodiscard]] ExplorationJudge make_exploration_judge(const Brief& brief, const World& world);

}  // namespace flyball
