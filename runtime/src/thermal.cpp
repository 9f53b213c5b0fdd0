// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/thermal.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {

ThermalState::ThermalState(const ThermalModel& model, Watts before)
    : model_{model},
      capacity_j_k_{model.time_constant_s / model.resistance_k_w},
      temperature_c_{model.ambient_c + model.resistance_k_w * before.value()},
      hottest_c_{temperature_c_},
      active_(model.trips.size()) {
  FLYBALL_ASSERT(model.resistance_k_w > 0.0 && model.time_constant_s > 0.0,
                 "resistance=%g K/W, time constant=%g s", model.resistance_k_w,
                 model.time_constant_s);
  look_at_trips();
}

void ThermalState::step(Watts power, double dt_s) {
  const double rest_c = model_.ambient_c + model_.resistance_k_w * power.value();
  temperature_c_ = rest_c + (temperature_c_ - rest_c) * std::exp(-dt_s / model_.time_constant_s);
  hottest_c_ = std::max(hottest_c_, temperature_c_);
  look_at_trips();
}

void ThermalState::set_cooling(double ambient_c, double resistance_k_w) {
  FLYBALL_ASSERT(resistance_k_w > 0.0, "resistance=%g K/W", resistance_k_w);
  model_.ambient_c = ambient_c;
  model_.resistance_k_w = resistance_k_w;
  model_.time_constant_s = resistance_k_w * capacity_j_k_;
}

void ThermalState::set_temperature(double temperature_c) {
  temperature_c_ = temperature_c;
  hottest_c_ = temperature_c;
  look_at_trips();
}

void ThermalState::look_at_trips() {
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const ThermalTrip& trip = model_.trips[i];
    const double from_c = active_[i] ? trip.at_c - trip.hysteresis_k : trip.at_c;
    active_[i] = temperature_c_ >= from_c;
  }
}

std::optional<Hertz> ThermalState::cap() const {
  std::optional<Hertz> lowest;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (active_[i] && (!lowest || model_.trips[i].cap < *lowest)) {
      lowest = model_.trips[i].cap;
    }
  }
  return lowest;
}

std::optional<double> ThermalState::first_trip_c() const {
  return model_.trips.empty() ? std::nullopt : std::optional{model_.trips.front().at_c};
}

}  // namespace flyball
