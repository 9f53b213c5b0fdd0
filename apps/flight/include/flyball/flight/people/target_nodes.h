// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From colour camera to the followed person, as in MAVBench's aerial photography (MICRO 2018,
/// section IV). A detector searches whole frames and is slow. A buffered tracker follows its
/// detection through the frames that came meanwhile, and a real-time tracker goes on from there.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/perception/localization_nodes.h"

#include <optional>
#include <vector>

namespace flyball {

/// What the detector saw in one frame.
struct Detections {
  ColourFrame frame{};
  std::vector<Detection> people{};
};

/// On a link: the boxes; the picture is on board.
[[nodiscard]] inline double wire_bytes(const Detections& seen) {
  return static_cast<double>(sizeof(Detections) + seen.people.size() * sizeof(Detection));
}

/// Counts that decide the end of the mission, and figures of quality.
struct TargetLog {
  int detections{};     ///< Frames in which the person was detected.
  int missed_in_row{};  ///< Newest detections in a row without the person.
  std::uint64_t looks{};
  std::uint64_t buffered_frames{};
};

/// A detection that the buffered tracker has followed to the newest frame of its buffer.
struct CaughtUp {
  ColourFrame frame{};
  std::optional<ImageBox> box{};   ///< Empty: nobody was detected, or the tracker lost them.
  std::uint64_t frames_between{};  ///< From the detector's frame to this one.
  TargetLog log{};
};

/// Where the person is in the newest frame that was tracked.
struct Target {
  ColourFrame frame{};
  std::optional<ImageBox> box{};
};

struct TargetTopics {
  Topic<PoseEstimate> pose;
  Topic<Detections> detections;
  Topic<Target> sighting;  ///< The person as detected, in the detector's frame.
  Topic<CaughtUp> caught_up;
  Topic<Target> target;
};

/// Chooses the followed person among the detections: the one nearest to the last box, if it is
/// within `reach_px`; without a last box the one with the highest score. Empty when there is none.
[[nodiscard]] std::optional<Detection> pick(const std::vector<Detection>& people,
                                            const std::optional<ImageBox>& last,
                                            double reach_px);

/// The detections that have a person's size at their place on the ground. All of them, when the
/// height of the camera is not known yet.
[[nodiscard]] std::vector<Detection> plausible(const Detections& seen,
                                               const PoseEstimate* pose,
                                               const Brief& brief);

/// Adds the nodes `detect`, `track_buffered` and `track_real_time`.
[[nodiscard]] TargetTopics add_target(Graph& graph,
                                      const FlightParts& parts,
                                      const LocalizationTopics& localization);

}  // namespace flyball
