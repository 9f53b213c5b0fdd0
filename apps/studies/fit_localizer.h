// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a localizer that takes images does in the recorded scenes.

#include "flyball/kernels/visual_frame.h"

#include "studies/fit_scenes.h"

namespace flyball {

/// A straight flight without dynamics, from rest, at `speed_m_s` after a second, or at once when
/// the speed is a walker's.
struct Stretch {
  Pose X_WB{Pose::Identity()};  ///< At its begin; the vehicle flies along x of B.
  double speed_m_s{};
  double duration_s{};
};

/// The frames of a stretch, at the rate of the scenario's camera.
/// @error `not_found`, `invalid_input`: as `ColourCamera::make`.
[[nodiscard]] Result<std::vector<VisualFrame>> frames_of(const Stretch& stretch,
                                                         const Scenario& scenario,
                                                         const World& world);

/// Lets localizer `visual_slam`, with ORB-SLAM2's thresholds for corners, as MAVBench flew it,
/// track each stretch from a fresh start, and adds its work on all frames but the first, which only
/// starts the map, to `visual_slam_frames` of `loads`.
/// @error As `frames_of` and `Localizer::track_frame`.
[[nodiscard]] Status track_stretches(const std::vector<Stretch>& stretches,
                                     const Scenario& scenario,
                                     const World& world,
                                     KernelLoads& loads);

}  // namespace flyball
