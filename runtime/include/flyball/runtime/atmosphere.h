// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Height and air pressure in the International Standard Atmosphere (ISO 2533), below 11 km.

namespace flyball {

/// Pressure [Pa] at a height [m] above the sea.
[[nodiscard]] double standard_pressure_pa(double height_m);
/// The height [m] at which the standard atmosphere has this pressure [Pa]. On another day than the
/// standard one it is off, but differences of heights are right within the air's temperature:
/// 10 K off are 3.5 %.
/// @pre `pressure_pa` > 0.
[[nodiscard]] double pressure_height_m(double pressure_pa);

}  // namespace flyball
