// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How warm the computer gets: it is kept busy, then left alone, and watched meanwhile.

#include "flyball/runtime/result.h"
#include "flyball/runtime/thermal.h"

#include <chrono>
#include <functional>
#include <vector>

namespace flyball {

struct HeatSample {
  double t_s{};   ///< Ascending.
  Watts power{};  ///< Mean since the sample before.
  double temperature_c{};
};

struct HeatMeasurement {
  std::vector<int> cpus{};  ///< Kept busy, all of them.
  std::function<HeatSample()> meter{};
  std::chrono::nanoseconds phase{std::chrono::minutes{3}};   ///< Busy, and then as long again idle.
  std::chrono::nanoseconds period{std::chrono::seconds{1}};  ///< Between two samples.
  std::function<bool()> stop{};  ///< May be empty. True: it ends as `unavailable`.
};

/// Takes twice the phase. Nothing else should run meanwhile.
/// @error `unavailable`: no thread may run on a core, or it was stopped.
[[nodiscard]] Result<std::vector<HeatSample>> measure_heat(const HeatMeasurement& how);

struct HeatFit {
  ThermalModel model{};  ///< Without trips.
  double worst_k{};      ///< The farthest that a sample is off.
};

/// `ThermalModel` by least squares. For one time constant the temperature of a body with
///
///     tau dT/dt = T_air + R P - T
///
/// is linear in T_air, R and the temperature at the beginning; the time constant is searched for.
/// @error `failed`: the samples do not tell, because the temperature changed by under 3 K, or
///        the best time constant is under two samples or beyond what was watched.
[[nodiscard]] Result<HeatFit> fitted_heat(const std::vector<HeatSample>& samples);

}  // namespace flyball
