// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The same small patch of the world in two images, to a fraction of a pixel.

#include "flyball/kernels/visual_frame.h"

#include <optional>
#include <vector>

namespace flyball {

/// Standard deviation of a place that `follow_patches` gives. On rendered views it is .1 to .3 px;
/// .2 px gives the least drift on the 25 m circle (tests/bench/slam_bench).
constexpr double patch_sigma_px = 0.2;

struct PatchPair {
  Eigen::Vector2d before{Eigen::Vector2d::Zero()};  ///< Known place, distortion not removed.
  Eigen::Vector2d now{Eigen::Vector2d::Zero()};     ///< About where it is now.
};

/// Lucas-Kanade (Bouguet 2000) from the place where it should be. FAST finds whole pixels of its
/// octave, so that the same corner is up to a pixel off in two images; its neighbourhood is not.
///
/// @pre    Both images have `width_px` times `height_px` pixels.
/// @return As many as `pairs`; none where the patch has no texture, or would be farther than 3 px
///         from where it should be. All none when OpenCV refuses the images.
[[nodiscard]] std::vector<std::optional<Eigen::Vector2d>> follow_patches(
    const std::vector<std::uint8_t>& before,
    const std::vector<std::uint8_t>& now,
    const CameraModel& camera,
    const std::vector<PatchPair>& pairs);

}  // namespace flyball
