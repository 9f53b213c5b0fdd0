// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How far the world, not the sensor's range, lets see along the way.

#include "flyball/runtime/observation.h"
#include "flyball/runtime/time.h"

#include <cstdint>

namespace flyball {

/// What is known to be free ahead saws with each map and each bend; measured from where the newest
/// map was captured, the longest of about the last second counts. Where the range ended it, the
/// world may show more: then sight grows by a share at each look, so that longer ranges are tried
/// one after the other. Nothing allocates.
class Sight {
 public:
  /// @param first_m  Before anything was seen.
  explicit Sight(double first_m) : sight_m_{first_m} {}

  /// @param range_m  That is in force now; the newest map's is the one that was in force when its
  ///                 frame was taken. What is no number changes nothing, and neither does what is
  ///                 seen before or after cruise.
  void note(const Observation& seen, double range_m);
  [[nodiscard]] double distance_m() const { return sight_m_; }

 private:
  double sight_m_;
  std::uint64_t revision_{};
  MissionTime captured_{};  ///< The newest map's frame.
  double range_m_{};
  double last_range_m_{};  ///< Until `changed_`.
  MissionTime changed_{};
};

}  // namespace flyball
