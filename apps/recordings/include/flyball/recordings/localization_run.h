// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A localizer on a recorded flight.

#include "flyball/recordings/trajectory_error.h"
#include "flyball/scenario/plugins.h"

#include <functional>
#include <memory>
#include <optional>

namespace flyball {

class Localizer;

struct LocalizationRun {
  std::vector<TimedPose> path{};  ///< Of the frames that gave a pose.
  int frames{};
  int lost{};             ///< Frames that gave none.
  int uncertain{};        ///< Frames whose pose is, as the localizer itself says, no good.
  double sigma_m_last{};  ///< Root mean square of the error that it expects in its last pose.
  int keyframes{};
  int loops_closed{};
  double frame_ms_mean{};  ///< Of the host, without reading the files.
  double frame_ms_max{};
  std::optional<TrajectoryError> error{};  ///< When there is a true path.
};

/// Feeds the recording to a localizer that has not started yet. `stop` is asked before each frame.
/// @param uncertain_above_m  A pose is uncertain when the localizer expects a larger error.
/// @error `invalid_input`: an image that cannot be read, or the recording lacks what the localizer
///        needs.
[[nodiscard]] Result<LocalizationRun> localize(const Recording& recording,
                                               Localizer& localizer,
                                               const std::function<bool()>& stop,
                                               double uncertain_above_m = 0.1);

/// A localizer that sees, by its name among `plugins`.
/// @error `not_found`, `invalid_input` with the names of those that do.
[[nodiscard]] Result<std::unique_ptr<Localizer>> make_seeing_localizer(const std::string& name,
                                                                       const Plugins& plugins);

}  // namespace flyball
