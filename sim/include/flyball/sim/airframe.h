// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a vehicle is made of; read from sim/airframes/NAME.toml, each number with its source.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/result.h"

#include <array>
#include <string>

namespace flyball {

struct Airframe {
  std::string name;
  double mass_kg{};
  double arm_m{};                 ///< Rotor axis from the centre.
  double rotor_diameter_m{};
  double thrust_coefficient{};    ///< T = C_T rho n^2 D^4, n in 1/s.
  double power_coefficient{};     ///< P = C_P rho n^3 D^5.
  double max_rotor_rpm{};
  double rotor_lag_s{};           ///< First-order time constant.
  Vec3 body_size_m{Vec3::Zero()}; ///< Box for the moments of inertia.
  double body_diameter_m{};       ///< Of the collision cylinder (tip to tip where it must fit a door).
  double body_height_m{};
  double drag_area_m2{};          ///< c_d A of the body.
  std::array<double, 9> power_b{};///< MAVBench eq. 1, b1..b9; payload in grams.
  double battery_v{};
  double battery_ah{};
  int battery_cells{};

  [[nodiscard]] Cylinder body() const { return {0.5 * body_diameter_m, 0.5 * body_height_m}; }
};

/// @error `not_found`, `invalid_input`: unknown keys and impossible values, all in one message.
[[nodiscard]] Result<Airframe> load_airframe(const std::string& path);

}  // namespace flyball
