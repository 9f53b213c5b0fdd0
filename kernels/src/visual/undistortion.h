// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a lens bends, made straight.

#include "flyball/kernels/visual_frame.h"

#include <optional>
#include <vector>

namespace flyball {

[[nodiscard]] bool is_distorted(const CameraModel& camera);

/// The direction behind each pixel, scaled to z = 1. Empty where the lens's formula has no answer,
/// or where the direction lies more than 80 degrees from the axis: a plane at z = 1 cannot show it.
[[nodiscard]] std::vector<std::optional<Eigen::Vector2f>> straight_rays(
    const CameraModel& camera, const std::vector<Eigen::Vector2f>& pixels);

/// Where a camera without distortion sees the pixels; those of such a camera are returned as they
/// are. Empty as `straight_rays` is.
[[nodiscard]] std::vector<std::optional<Eigen::Vector2f>> straightened(
    const CameraModel& camera, const std::vector<Eigen::Vector2f>& pixels);

}  // namespace flyball
