// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/atmosphere.h"

#include <cmath>

namespace flyball {
namespace {

// ISO 2533: at sea level, and the fall of temperature with height.
constexpr double sea_level_pa = 101325.0;
constexpr double sea_level_k = 288.15;
constexpr double lapse_k_m = 0.0065;
constexpr double gravity_m_s2 = 9.80665;
constexpr double gas_j_kg_k = 287.05287;  // Of dry air.
constexpr double exponent = gravity_m_s2 / (gas_j_kg_k * lapse_k_m);

}  // namespace

double standard_pressure_pa(double height_m) {
  return sea_level_pa * std::pow(1.0 - lapse_k_m * height_m / sea_level_k, exponent);
}

double pressure_height_m(double pressure_pa) {
  return sea_level_k / lapse_k_m * (1.0 - std::pow(pressure_pa / sea_level_pa, 1.0 / exponent));
}

}  // namespace flyball
