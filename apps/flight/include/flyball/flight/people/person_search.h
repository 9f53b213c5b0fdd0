// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Looks for people on the way, and says where in the world they are.

#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/kernels/detector.h"

namespace flyball {

/// Somebody whom the detector saw.
struct Sighting {
  ImageBox box{};
  double score{};
  Vec3 p_W{Vec3::Zero()};  ///< Of the surface in the box's middle.
};

struct Sightings {
  ColourFrame frame{};
  Vec3 from_W{Vec3::Zero()};  ///< Where the vehicle believes that it took the frame.
  std::vector<Sighting> people{};
};

/// Where the middle of a box in a colour image is, by a depth image that was taken at the same time
/// by the level camera in the body's centre: the median depth of the box's inner quarter.
///
/// @param X_WB  Pose of the body at that time; only its heading counts.
/// @return      Empty where the depth image does not reach, or saw nothing.
[[nodiscard]] std::optional<Vec3> place_of(const ImageBox& box,
                                           const ColourFrame& frame,
                                           const DepthImage& depth,
                                           const Pose& X_WB);

/// Adds the node `detect`. A detection that has no place is left out.
[[nodiscard]] Topic<Sightings> add_person_search(Graph& graph,
                                                 const VehicleTopics& vehicle,
                                                 const PerceptionTopics& perception,
                                                 MissionContext& context);

}  // namespace flyball
