// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How often plans fail in large cells, and how often the vehicle stops.

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
/// small that the first failure outweighs it). Smaller cells have no price.
///
/// An exploration stops at each view until a frame that was taken at rest is in the map; a delivery
/// hardly ever does. So the stops say what the latency of a map costs beside speed. They begin with
/// half a stop in 50 m (chosen: the first stops of an exploration outweigh it). Nothing allocates
/// after construction.
class FailedPlans {
 public:
  /// @param levels_m  Cell sizes, finest first. @param large_m  Larger cells are large.
  FailedPlans(const std::vector<double>& levels_m, double large_m);

  /// @param resolution_m  Of the map since the last call.
  void note(const Observation& seen, double resolution_m);
  /// Of each level [1/m].
  [[nodiscard]] const std::vector<double>& per_m() const { return per_m_; }
  [[nodiscard]] double stops_per_m() const { return stops_ / flown_m_; }

 private:
  void count_stop(const Observation& seen);
  struct Level {
    double resolution_m{};
    double failures{0.5};
    double flown_m{250.0};
  };
  double large_m_;
  std::vector<Level> levels_{};
  std::vector<double> per_m_{};
  double stops_{0.5};
  double flown_m_{50.0};
  bool is_flying_{};
  std::uint32_t in_a_row_{};
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
