// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Looks for people during the flight, and tells where in the world they are.

#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/kernels/detector.h"

namespace flyball {

/// A person whom the detector saw.
struct Sighting {
  ImageBox box{};
  double score{};
  Vec3 p_W{Vec3::Zero()};  ///< Place of the surface in the middle of the box.
};

struct Sightings {
  ColourFrame frame{};
  Vec3 from_W{Vec3::Zero()};  ///< Where the vehicle believes that it took the frame.
  std::vector<Sighting> people{};
};

/// On a link: people and their places; the picture is on board.
[[nodiscard]] inline double wire_bytes(const Sightings& seen) {
  return static_cast<double>(sizeof(Sightings) + seen.people.size() * sizeof(Sighting));
}

/// The place in the world of the middle of a box in a colour image. Its distance is the median
/// depth of the box's inner quarter in a depth image that was taken at the same time. The two
/// cameras are taken to be at one place: what lies between them is small beside the distance.
///
/// @param mount  Of the depth camera.
/// @param X_WB   Pose of the body at that time; of its attitude only the heading counts.
/// @return       Empty where the depth image does not reach, or has no return.
[[nodiscard]] std::optional<Vec3> place_of(const ImageBox& box,
                                           const ColourFrame& frame,
                                           const DepthImage& depth,
                                           const DepthCameraSpec& mount,
                                           const Pose& X_WB);

/// Adds the node `detect`. A detection that has no place is left out.
[[nodiscard]] Topic<Sightings> add_person_search(Graph& graph,
                                                 const FlightParts& parts,
                                                 const LocalizationTopics& localization);

}  // namespace flyball
