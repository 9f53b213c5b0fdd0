// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a vehicle is made of; read from sim/airframes/NAME.toml, each number with its source.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/result.h"

#include <array>
#include <string>
#include <vector>

namespace flyball {

constexpr double gravity_m_s2 = 9.80665;     ///< Standard gravity (CGPM 1901).
constexpr double air_density_kg_m3 = 1.225;  ///< ISA at sea level.

struct Airframe {
  std::string name;
  double mass_kg{};
  double rotor_mass_kg{};  ///< Of one motor with propeller, part of `mass_kg`.
  double arm_m{};          ///< Rotor axis from the centre.
  double rotor_diameter_m{};
  double thrust_coefficient{};  ///< T = C_T rho n^2 D^4, n in 1/s.
  double power_coefficient{};   ///< P = C_P rho n^3 D^5.
  double max_rotor_rpm{};
  double rotor_lag_s{};            ///< First-order time constant.
  Vec3 body_size_m{Vec3::Zero()};  ///< Box for the moments of inertia.
  double body_diameter_m{};  ///< Of the collision cylinder (tip to tip where it must fit a door).
  double body_height_m{};    ///< Of the collision cylinder: the feet stand on its lower face.
  double drag_area_m2{};     ///< c_d A of the body.
  std::array<double, 9>
      power_b{};  ///< MAVBench eq. 1, b1..b9; payload in grams. All zero: not known.
  double battery_v{};
  double battery_ah{};
  int battery_cells{};

  [[nodiscard]] Cylinder body() const { return {0.5 * body_diameter_m, 0.5 * body_height_m}; }
  /// Whether eq. 1 was fitted for this vehicle; without it only the thrust model gives a power.
  [[nodiscard]] bool has_regression() const { return power_b[8] > 0.0; }

  /// A box plus four point masses on the arms, without payload: about x, y, z [kg m^2].
  [[nodiscard]] Vec3 inertia_kg_m2() const;
  /// Where the rotors' axes stand, in the order of `RotorSpeeds` (X layout, in the body's plane).
  [[nodiscard]] std::array<Vec3, 4> rotor_points_B() const;
  /// A foot under the middle of each arm, on the lower face of the collision cylinder [m].
  [[nodiscard]] std::array<Vec3, 4> foot_points_B() const;
  /// Thrust of one rotor over n^2 [N s^2].
  [[nodiscard]] double thrust_per_n2() const;
  /// Reaction torque of one rotor over n^2, P / omega [N m s^2].
  [[nodiscard]] double torque_per_n2() const;
  /// Shaft power of one rotor over n^3 [W s^3].
  [[nodiscard]] double power_per_n3() const;
  [[nodiscard]] double max_rotor_rev_s() const { return max_rotor_rpm / 60.0; }
  /// At which its rotors hold the vehicle with so much beside it in calm air [1/s].
  [[nodiscard]] double hover_rev_s(double carried_kg) const;
  /// So much its rotors lift with a fifth to spare, beside the vehicle itself.
  [[nodiscard]] double most_payload_kg() const;

  /// Every violation, with both sides of the inequality; empty when it can fly.
  [[nodiscard]] std::vector<Error> validate() const;
};

/// @error `not_found`, `invalid_input`: unknown keys and impossible values, all in one message.
[[nodiscard]] Result<Airframe> load_airframe(const std::string& path);

}  // namespace flyball
