// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From navigation samples and camera frames to poses.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/perception/rate_limit.h"

#include <optional>

namespace flyball {

/// Whether a localizer that takes images still knows where the vehicle is.
struct LocalizationStatus {
  bool is_lost{};
  std::optional<Setpoint> search{};  ///< While it is lost: where to look for a known place.
  int times_lost{};
  double lost_s{};
};

struct LocalizationTopics {
  Topic<PoseEstimate> pose;          ///< The newest one.
  Topic<PoseEstimate> poses;         ///< A queue of them all, for those who look back.
  Topic<LocalizationStatus> status;  ///< Only of a localizer that takes images.
};

/// Whether localization looks at a frame, by the knob `localizer.rate_hz`, if there is one.
/// @param limit  That of the node. @pre The node reads `knobs`.
[[nodiscard]] bool is_localizers_turn(JobContext& job,
                                      const MissionTopics& mission,
                                      RateLimit& limit,
                                      MissionTime captured);

/// Adds the node `localize` and, for a localizer that takes images, the node `see`, which processes
/// frames and takes time for it.
[[nodiscard]] LocalizationTopics add_localization(Graph& graph, const FlightParts& parts);

}  // namespace flyball
