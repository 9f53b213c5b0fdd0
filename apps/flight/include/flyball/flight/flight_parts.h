// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the builders of nodes are given. Nodes share nothing else but the topics they declare.

#include "flyball/flight/brief.h"
#include "flyball/flight/mission_kernels.h"
#include "flyball/flight/mission_topics.h"
#include "flyball/flight/vehicle_port.h"

#include <memory>

namespace flyball {

struct FlightParts {
  std::shared_ptr<const Brief> brief{};  ///< Owners: the nodes.
  VehicleTopics vehicle{};
  MissionTopics mission{};
  MissionKernels kernels{};
};

}  // namespace flyball
