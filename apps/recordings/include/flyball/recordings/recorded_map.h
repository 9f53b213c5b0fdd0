// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A map of a recorded flight: its depth images, and poses that somebody knows.

#include "flyball/kernels/mapper.h"
#include "flyball/recordings/recording.h"
#include "flyball/scenario/plugins.h"

#include <functional>
#include <memory>
#include <optional>

namespace flyball {

struct MappingSettings {
  MapperSettings map{0.1, 5.0};  ///< Kinect's depth is good to 5 m (Khoshelham & Elberink 2012).
  int every{1};                  ///< One frame in so many is used.
  /// A frame between two poses gets one in between when they are at most so far apart; zero: a
  /// frame needs a pose of its own time.
  Duration widest_gap{std::chrono::milliseconds{100}};
};

struct MappingRun {
  int frames{};        ///< That were asked for.
  int without_pose{};  ///< Of these, the ones that were left out.
  double rays{};
  double updates{};  ///< Cells, each once a frame.
};

/// Feeds the recording's depth to a mapper. A pixel without depth says nothing: cameras measure
/// none on glass and on what is too near, so that its ray is not free. One beyond the range frees
/// its ray up to there.
///
/// @param poses  Of the body, in order of time.
/// @param stop   Asked before each frame.
/// @error `invalid_input`: the recording has no depth, its lens bends (which no reader does for
///        depth), an image cannot be read, the mapper refuses, or no frame has a pose.
[[nodiscard]] Result<MappingRun> map_recording(const Recording& recording,
                                               const std::vector<TimedPose>& poses,
                                               const MappingSettings& settings,
                                               Mapper& mapper,
                                               const std::function<bool()>& stop);

/// The pose at a time, in between two of them where they are at most `widest_gap` apart.
/// @param poses  In order of time.
[[nodiscard]] std::optional<Pose> pose_between(const std::vector<TimedPose>& poses,
                                               MissionTime t,
                                               Duration widest_gap);

/// A mapper, by its name among `plugins`, configured.
/// @param finest_m  Its finest cells, where it lets one choose them; empty: as it has them.
/// @error `not_found` with the names of those that there are; those of `Kernel::configure`.
[[nodiscard]] Result<std::unique_ptr<Mapper>> make_mapper(
    const std::string& name, const Plugins& plugins, std::optional<double> finest_m = std::nullopt);

}  // namespace flyball
