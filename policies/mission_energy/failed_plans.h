// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How often plans fail in large cells.

#include "flyball/runtime/observation.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <optional>

namespace flyball {

/// Large cells close openings that nobody has seen yet. The vehicle finds that out when a plan
/// fails, and stops. This class counts such failures per metre flown with large cells. It begins
/// with half a failure in 250 m (chosen: rare enough that large cells are tried, and so small that
/// the first failure outweighs it). Nothing allocates.
class FailedPlans {
 public:
  /// @param in_large_cells  Whether the map has had large cells since the last call.
  void note(const Observation& seen, bool in_large_cells);
  /// [1/m].
  [[nodiscard]] double per_m() const { return failures_ / flown_m_; }

 private:
  double failures_{0.5};
  double flown_m_{250.0};
  std::uint32_t in_a_row_{};
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
