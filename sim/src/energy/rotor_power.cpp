// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/rotor_power.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double fastest_m_s = 15.0;       // beyond it the regression has no data
constexpr double low_pass_s = 0.5;         // b5 would rectify jitter at 31.7 W per m/s^2
constexpr double least_share_of_b9 = 0.5;  // b1 < 0 would make fast flight free
constexpr double rest_rev_s = 1.0;         // slower than any rotor that carries load
constexpr double grams_per_kg = 1000.0;    // eq. 1 takes the payload in grams

Vec3 clamped(const Vec3& v_WB) {
  const double speed_m_s = v_WB.norm();
  return speed_m_s > fastest_m_s ? Vec3{v_WB * (fastest_m_s / speed_m_s)} : v_WB;
}

}  // namespace

double RegressionPower::update(const VehicleState& state,
                               double payload_kg,
                               const Vec3& wind_W,
                               double dt_s) {
  FLYBALL_ASSERT(airframe_.has_regression(), "no power_b for %s: use the thrust model",
                 airframe_.name.c_str());
  acceleration_ += (1.0 - std::exp(-dt_s / low_pass_s)) * (state.a_WB - acceleration_);
  const auto& rotors = state.rotor_rev_s;
  if (*std::max_element(rotors.begin(), rotors.end()) < rest_rev_s) {
    return 0.0;
  }
  const auto& b = airframe_.power_b;
  const Vec3 v = clamped(state.v_WB);
  const Vec3& a = acceleration_;
  const double v_xy = v.head<2>().norm();
  const double a_xy = a.head<2>().norm();
  const double v_z = std::abs(v.z());
  const double a_z = std::abs(a.z());
  const double power_w = b[0] * v_xy + b[1] * a_xy + b[2] * v_xy * a_xy + b[3] * v_z + b[4] * a_z +
                         b[5] * v_z * a_z + b[6] * grams_per_kg * payload_kg +
                         b[7] * v.head<2>().dot(wind_W.head<2>()) + b[8];  // MAVBench eq. 1
  return std::max(power_w, least_share_of_b9 * b[8]);
}

double thrust_power_w(const Vehicle& vehicle, double drive_efficiency) {
  FLYBALL_ASSERT(drive_efficiency > 0.0 && drive_efficiency <= 1.0, "drive_efficiency=%g",
                 drive_efficiency);
  return vehicle.shaft_power_w() / drive_efficiency;
}

}  // namespace flyball
