// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How a set-point moves on: between two of them, to a stop, and up to a height. A simulated flight
/// controller and the link to a real one fly the same motions.

#include "flyball/runtime/messages.h"

namespace flyball {

/// From one velocity towards another one, by `largest` at most [m/s].
[[nodiscard]] Vec3 stepped_velocity(const Vec3& from, const Vec3& to, double largest);

/// Where a set-point has moved `age_s` after its stamp when no newer one came. Position and
/// velocity go on with the acceleration: a braking one until it stands, another one for .1 s, and
/// then at constant velocity. The yaw goes on at its rate.
[[nodiscard]] Setpoint extrapolated(const Setpoint& newest, double age_s);

/// Slows the reference's velocity down by 5 m/s^2 for `dt_s`, until it is zero.
void brake_reference(Setpoint& reference, double dt_s);

/// Lets the reference's velocity bring it to `height_m` in W at 1.5 m/s, with 2 m/s^2 at both ends.
/// Arriving, it puts the reference there and stops it.
void climb_reference(Setpoint& reference, double height_m, double dt_s);

/// Moves the reference's position on at its velocity; the acceleration is what changed the velocity
/// since it was `before_m_s`.
void move_reference(Setpoint& reference, const Vec3& before_m_s, double dt_s);

}  // namespace flyball
