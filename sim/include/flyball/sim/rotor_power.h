// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Electrical power of the rotors, two models.

#include "flyball/sim/airframe.h"
#include "flyball/sim/vehicle.h"

namespace flyball {

/// MAVBench (MICRO 2018) eq. 1, after Tseng et al. (arXiv 1703.10049):
/// P = b1|v_xy| + b2|a_xy| + b3|v_xy||a_xy| + b4|v_z| + b5|a_z| + b6|v_z||a_z| + b7 m + b8 (v_xy .
/// w_xy) + b9. A regression, so |v| is clamped at 15 m/s, the acceleration passes a .5 s low-pass,
/// and P >= .5 b9.
class RegressionPower {
 public:
  explicit RegressionPower(const Airframe& airframe) : airframe_{airframe} {}
  /// Advances the low-pass by `dt_s` and returns the power [W]. Rotors at rest take none.
  /// @pre `airframe.has_regression()`.
  [[nodiscard]] double update(const VehicleState& state,
                              double payload_kg,
                              const Vec3& wind_W,
                              double dt_s);

 private:
  Airframe airframe_;
  Vec3 acceleration_{Vec3::Zero()};
};

/// Shaft power over the drive's efficiency: C_P rho n^3 D^5 summed over rotors / efficiency.
[[nodiscard]] double thrust_power_w(const Vehicle& vehicle, double drive_efficiency);

}  // namespace flyball
