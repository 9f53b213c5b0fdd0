// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/power_model.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// Speeds change within one sample, and climbing is not in the model; tens of watts in a delivery.
constexpr double noise_w = 30.0;
constexpr double power_forgetting = 0.999;
// A quarter of hover: no multirotor flies level on less, and a fit from few samples might say so.
constexpr double least_share = 0.25;
constexpr double most_speed_m_s = 100.0;
constexpr double most_power_w = 1e5;

using Row = Eigen::Vector3d;

}  // namespace

RotorPower::RotorPower(const Prior& prior)
    : solver_{Row{prior.hover_w, prior.linear_w_s_m, prior.quadratic_w_s2_m2},
              Row{prior.sigma_hover_w, prior.sigma_linear_w_s_m, prior.sigma_quadratic_w_s2_m2} /
                  noise_w,
              power_forgetting} {}

Watts RotorPower::power(double speed_m_s) const {
  const double fitted_w = solver_.predict({1.0, speed_m_s, speed_m_s * speed_m_s});
  return Watts{std::max(fitted_w, least_share * std::max(0.0, solver_.weights()(0)))};
}

double RotorPower::slope_w_s_m(double speed_m_s) const {
  return solver_.weights()(1) + 2.0 * solver_.weights()(2) * speed_m_s;
}

void RotorPower::learn(double speed_m_s, Watts measured) {
  // false for NaN; what is larger is a broken sensor, and its square would spoil the fit for good
  const bool is_flight = std::abs(speed_m_s) < most_speed_m_s && measured.value() > 0.0 &&
                         measured.value() < most_power_w;
  if (is_flight) {
    solver_.learn({1.0, speed_m_s, speed_m_s * speed_m_s}, measured.value());
  }
}

double joules_per_metre(Watts rotors, Watts computer, double speed_m_s) {
  FLYBALL_ASSERT(speed_m_s > 0.0, "speed_m_s=%g", speed_m_s);
  return (rotors + computer).value() / speed_m_s;
}

}  // namespace flyball
