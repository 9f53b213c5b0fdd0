// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/power_meters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flyball {
namespace {

constexpr double rounding_s = 1e-9;  // Ten times 10 ms are a bit less than .1 s in binary.
constexpr double zone_step_c = 0.5;

}  // namespace

void PowerMonitor::add(Watts power, double dt_s) {
  energy_j_ += power.value() * dt_s;
  time_s_ += dt_s;
  if (time_s_ < reading_s - rounding_s) {
    return;
  }
  readings_w_[readings_ % readings_w_.size()] = step_w * std::round(energy_j_ / (time_s_ * step_w));
  ++readings_;
  energy_j_ = time_s_ = 0.0;
  const std::size_t count = std::min(readings_, readings_w_.size());
  mean_ = Watts{std::accumulate(readings_w_.begin(),
                                readings_w_.begin() + static_cast<std::ptrdiff_t>(count), 0.0) /
                static_cast<double>(count)};
}

PowerModule::PowerModule(double battery_percent, std::uint64_t seed)
    : noise_{seed, "power_module"},
      gain_{1.0 + gain_sigma * noise_.normal()},
      percent_{std::round(battery_percent)} {}

void PowerModule::add(Watts rotors, double battery_percent, double dt_s) {
  since_s_ += dt_s;
  if (since_s_ >= message_s - rounding_s) {
    since_s_ = 0.0;
    rotors_ = Watts{rotors.value() * gain_ * (1.0 + noise_sigma * noise_.normal())};
    percent_ = std::round(battery_percent);
  }
}

double thermal_zone_c(double temperature_c) {
  return zone_step_c * std::round(temperature_c / zone_step_c);
}

}  // namespace flyball
