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

// Kept below the trip: one step of a usual sensor (TMP451: .5 K by NVIDIA's driver).
constexpr double guard_k = 0.5;
// Within so long the limit may be reached: well below time constants of minutes, well above the
// seconds in which loads change.
constexpr double horizon_s = 60.0;
constexpr double raise_k = 0.25;        // Half a guard: a step of the clock changes .4 W, .35 K.
constexpr double window_s = 10.0;       // One sample of the model; ...
constexpr double first_window = 0.125;  // ... of the first so much, each next is twice as long.

constexpr double load_s =
    10.0;  // Over which the load is averaged: detectors and planners come and go.

bool is_told(const Observation& seen) {
  // Otherwise the temperature is not known, or the observation is faulty.
  const double hz = seen.frequency.value();
  return seen.trip_c > 0.0 && seen.trip_c < 1e3 && std::abs(seen.temperature_c) < 1e3 && hz > 1e6 &&
         hz < 1e11 && seen.busy_cores >= 0.0 && seen.busy_cores < 1e3;
}

}  // namespace

ThermalLimit::ThermalLimit(PowerCost computer)
    : computer_{std::move(computer)},
      solver_{Row{prior_q_k_s, prior_g_k_j, prior_k_1_s},
              Row{prior_q_k_s, prior_g_k_j, prior_k_1_s} * (prior_sigmas / noise_k),
              thermal_forgetting},
      window_s_{first_window * window_s} {}

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
  const bool goes_on = trip_c_ == seen.trip_c && dt_s >= 0.0 && dt_s <= window_s;
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
    window_s_ = std::min(2.0 * window_s_, window_s);
    solver_.learn({elapsed_s, energy_j_, -excess_k_s_}, seen.temperature_c - begun_c_);
    begin_window(seen);
  }
}

ThermalLimit::Fit ThermalLimit::fit() const {
  const Row& w = solver_.weights();
  return {w(0), std::clamp(w(1), least_g_k_j, most_g_k_j),
          std::clamp(w(2), least_k_1_s, most_k_1_s)};
}

/// That ends so far below the trip, drawn for one horizon.
Watts ThermalLimit::most_power(double below_trip_k) const {
  const auto [q, g, k] = fit();
  const double left = std::exp(-k * horizon_s);
  const double start_k = temperature_c_ - *trip_c_;
  return Watts{(k * (-below_trip_k - start_k * left) / (1.0 - left) - q) / g};
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
  const auto clock = [&](double below_trip_k) {
    return clock_for(most_power(below_trip_k), clocks_hz);
  };
  // Down at once, up with a reserve, and where even that reserve is less, it stays.
  last_hz_ = std::min(clock(guard_k), std::max(last_hz_, clock(guard_k + raise_k)));
  return last_hz_;
}

}  // namespace flyball
