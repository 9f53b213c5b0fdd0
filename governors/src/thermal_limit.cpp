// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/thermal_limit.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

using Row = Eigen::Vector3d;

// Before anything is learned: an embedded module, 100 J/K, behind a bad sink, 10 K/W, in air 45 K
// below the trip: 4.5 W for ever. Who begins close to the trip has no time to learn that it is so
// bad, and a better one shows in ten seconds. Each number may be wrong by three times what it is.
constexpr double prior_q_k_s = -45.0 / 1000.0;
constexpr double prior_g_k_j = 1.0 / 100.0;
constexpr double prior_k_1_s = 1.0 / 1000.0;
constexpr double prior_sigmas = 3.0;

// Of a difference of two readings in steps of .5 K: .5 sqrt(2 / 12).
constexpr double noise_k = 0.2;
// Wind and sun change in minutes: after some 50 windows, 8 minutes, a sample counts a third.
constexpr double thermal_forgetting = 0.98;

// A fit from few samples may say anything; no module weighs 10 g or 10 kg, or cools in 20 s.
constexpr double least_g_k_j = 1e-4;
constexpr double most_g_k_j = 0.1;
constexpr double least_k_1_s = 1e-5;
constexpr double most_k_1_s = 0.05;

constexpr double first_window = 0.125;  // Of the whole; each next one is twice as long.

constexpr double load_s =
    10.0;  // Over which the load is averaged: detectors and planners come and go.

bool is_told(const Observation& seen) {
  // Otherwise the temperature is not known, or the observation is faulty.
  const double hz = seen.frequency.value();
  return seen.trip_c > 0.0 && seen.trip_c < 1e3 && std::abs(seen.temperature_c) < 1e3 && hz > 1e6 &&
         hz < 1e11 && seen.busy_cores >= 0.0 && seen.busy_cores < 1e3;
}

}  // namespace

ThermalLimit::ThermalLimit(PowerCost computer, const ThermalLimitSettings& settings)
    : settings_{settings},
      computer_{std::move(computer)},
      solver_{Row{prior_q_k_s, prior_g_k_j, prior_k_1_s},
              Row{prior_q_k_s, prior_g_k_j, prior_k_1_s} * (prior_sigmas / noise_k),
              thermal_forgetting},
      window_s_{first_window * settings.window_s} {
  FLYBALL_ASSERT(settings.guard_k >= 0.0 && settings.horizon_s > 0.0 && settings.window_s > 0.0,
                 "guard_k=%g, horizon_s=%g, window_s=%g", settings.guard_k, settings.horizon_s,
                 settings.window_s);
}

void ThermalLimit::begin_window(const Observation& seen) {
  begun_ = seen.now;
  begun_c_ = seen.temperature_c;
  energy_j_ = 0.0;
  excess_k_s_ = 0.0;
}

void ThermalLimit::learn(const Observation& seen) {
  if (!is_told(seen)) {
    trip_c_.reset();
    return;
  }
  const double dt_s = to_seconds(seen.now - last_);
  const bool goes_on = trip_c_ == seen.trip_c && dt_s >= 0.0 && dt_s <= settings_.window_s;
  const double mean_c = 0.5 * (temperature_c_ + seen.temperature_c);
  trip_c_ = seen.trip_c;
  temperature_c_ = seen.temperature_c;
  last_ = seen.now;
  if (!goes_on) {
    busy_cores_ = seen.busy_cores;
    begin_window(seen);
    return;
  }
  busy_cores_ += (1.0 - std::exp(-dt_s / load_s)) * (seen.busy_cores - busy_cores_);
  energy_j_ += dt_s * computer_.power(seen.frequency, seen.busy_cores).value();
  excess_k_s_ += dt_s * (mean_c - seen.trip_c);
  const double elapsed_s = to_seconds(seen.now - begun_);
  if (elapsed_s >= window_s_) {
    window_s_ = std::min(2.0 * window_s_, settings_.window_s);
    solver_.learn({elapsed_s, energy_j_, -excess_k_s_}, seen.temperature_c - begun_c_);
    begin_window(seen);
  }
}

ThermalLimit::Fit ThermalLimit::fit() const {
  const Row& w = solver_.weights();
  return {w(0), std::clamp(w(1), least_g_k_j, most_g_k_j),
          std::clamp(w(2), least_k_1_s, most_k_1_s)};
}

Watts ThermalLimit::power_for(double end_k, double start_k, double seconds) const {
  const auto [q, g, k] = fit();
  const double left = std::exp(-k * seconds);
  return Watts{(k * (end_k - start_k * left) / (1.0 - left) - q) / g};
}

std::optional<Watts> ThermalLimit::most_power() const {
  if (!trip_c_) {
    return std::nullopt;
  }
  return power_for(-settings_.guard_k, temperature_c_ - *trip_c_, settings_.horizon_s);
}

std::optional<Watts> ThermalLimit::sustainable_power() const {
  if (!trip_c_) {
    return std::nullopt;
  }
  return power_for(-settings_.guard_k, 0.0, 1e9);
}

double ThermalLimit::temperature_after_c(Watts power, double seconds) const {
  FLYBALL_ASSERT(trip_c_.has_value(), "no trip was told, %g W", power.value());
  const auto [q, g, k] = fit();
  const double rest_k = (q + g * power.value()) / k;
  const double start_k = temperature_c_ - *trip_c_;
  return *trip_c_ + rest_k + (start_k - rest_k) * std::exp(-k * seconds);
}

double ThermalLimit::clock_for(Watts most, const std::vector<double>& clocks_hz) const {
  double best_hz = clocks_hz.front();
  for (const double one_hz : clocks_hz) {
    if (!(most < computer_.power(Hertz{one_hz}, busy_cores_))) {
      best_hz = one_hz;
    }
  }
  return best_hz;
}

double ThermalLimit::most_clock_hz(const std::vector<double>& clocks_hz) {
  FLYBALL_ASSERT(!clocks_hz.empty(), "%zu clocks", clocks_hz.size());
  if (!trip_c_) {
    return clocks_hz.back();
  }
  const double start_k = temperature_c_ - *trip_c_;
  const auto clock = [&](double below_k) {
    return clock_for(power_for(-settings_.guard_k - below_k, start_k, settings_.horizon_s),
                     clocks_hz);
  };
  // Down at once, up with a reserve, and where even that reserve is less, it stays.
  last_hz_ = std::min(clock(0.0), std::max(last_hz_, clock(settings_.raise_k)));
  return last_hz_;
}

}  // namespace flyball
