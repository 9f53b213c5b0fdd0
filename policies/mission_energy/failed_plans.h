// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How often plans fail in large cells.

#include "flyball/runtime/observation.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <optional>

namespace flyball {

/// Large cells shut openings that nobody has seen yet: the vehicle finds out by a plan that fails,
/// and stops. Counts such failures over the way that was flown with large cells. It begins with
/// half a failure in 250 m: rare enough that large cells are tried, so little that the first one
/// tells. Nothing allocates.
class FailedPlans {
 public:
  /// @param in_large_cells  Whether the map has had them since the last look.
  void note(const Observation& seen, bool in_large_cells);
  /// [1/m].
  [[nodiscard]] double per_m() const { return failures_ / way_m_; }

 private:
  double failures_{0.5};
  double way_m_{250.0};
  std::uint32_t in_a_row_{};
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
