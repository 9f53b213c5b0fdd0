// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How often plans fail in large cells.

#include "flyball/runtime/observation.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace flyball {

/// Large cells close openings that nobody has seen yet. The vehicle finds that out when a plan
/// fails, and stops. This class counts such failures per metre flown, for each level of large
/// cells. What larger cells leave open, smaller ones leave open too. So a failure counts for its
/// level and all coarser ones, and a metre flown for its level and all finer ones. Each level
/// begins with half a failure in 250 m (chosen: rare enough that large cells are tried, and so
/// small that the first failure outweighs it). Smaller cells have no price. Nothing allocates after
/// construction.
class FailedPlans {
 public:
  /// @param levels_m  Cell sizes, finest first. @param large_m  Larger cells are large.
  FailedPlans(const std::vector<double>& levels_m, double large_m);

  /// @param resolution_m  Of the map since the last call.
  void note(const Observation& seen, double resolution_m);
  /// Of each level [1/m].
  [[nodiscard]] const std::vector<double>& per_m() const { return per_m_; }

 private:
  struct Level {
    double resolution_m{};
    double failures{0.5};
    double flown_m{250.0};
  };
  double large_m_;
  std::vector<Level> levels_{};
  std::vector<double> per_m_{};
  std::uint32_t in_a_row_{};
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
