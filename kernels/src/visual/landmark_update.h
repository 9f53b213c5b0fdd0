// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a point that was followed over several images says about the poses they were taken from.

#include "visual/inertial_filter.h"
#include <optional>
#include <vector>

namespace flyball {

/// One image of the point.
struct Glimpse {
  std::size_t pose{};                            ///< Place in the filter's window.
  Eigen::Vector2d ray{Eigen::Vector2d::Zero()};  ///< In C, scaled to z = 1.
  std::optional<double> depth_m{};
};

/// Where the point is: least squares on all rays, and on the depths where there are some.
/// @return Empty when the rays are too parallel to tell (and there is no depth), when it would lie
///         behind a camera, or when the rays miss it by more than `reach` (of z = 1).
[[nodiscard]] std::optional<Vec3> triangulate(const std::vector<BodyPose>& window,
                                              const std::vector<Glimpse>& glimpses,
                                              double reach);

/// The point's own place is projected out (Mourikis & Roumeliotis 2007, eq. 22-24), so that only
/// the poses are left; noise is 1 in each row.
/// @param ray_sigma  Standard deviation of a ray's coordinates, of z = 1.
/// @pre               At least two glimpses.
[[nodiscard]] Innovation landmark_innovation(const InertialFilter& filter,
                                             const std::vector<Glimpse>& glimpses,
                                             const Vec3& p_W,
                                             double ray_sigma);

}  // namespace flyball
