// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much a computer may take without getting too hot: learned from its own thermometer.

#include "flyball/governors/recursive_least_squares.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/platform.h"
#include "flyball/runtime/units.h"

#include <limits>
#include <optional>
#include <vector>

namespace flyball {

/// One heat capacity behind one resistance, as `ThermalModel`, with x = T - trip:
///
///     dx/dt = q + g P - k x,    q = (T_air - trip) / tau,  g = 1 / C,  k = 1 / tau
///
/// q, g and k are learned by least squares over the integrals of one window after another,
///
///     x(t + w) - x(t) = q w + g int P dt - k int x dt,
///
/// which a sensor's steps spoil less than they would spoil a derivative. P is what the power model
/// says of the granted clock and the busy cores: a single look at a rail may meet a detector's
/// every frame or none, and what the model gets wrong by a factor or by watts goes into g and q.
///
/// The power that brings the computer from x to -guard in one horizon h, drawn for so long, is
///
///     P = (k (-guard - x e^{-k h}) / (1 - e^{-k h}) - q) / g.
///
/// Without a trip there is no limit. Nothing allocates.
class ThermalLimit {
 public:
  explicit ThermalLimit(PowerCost computer);

  /// Once per decision.
  void learn(const Observation& seen);

  /// The highest of these, ascending, that takes no more than P with the load as it was lately; the
  /// lowest where none does, and the highest of all where no trip is known. A higher one than the
  /// last answer must leave a quarter of a kelvin more: latencies are learned, and maps bounded, at
  /// a clock that stays for a while. @pre Not empty.
  [[nodiscard]] double most_clock_hz(const std::vector<double>& clocks_hz);

 private:
  struct Fit {
    double q_k_s{};
    double g_k_j{};
    double k_1_s{};
  };
  void begin_window(const Observation& seen);
  [[nodiscard]] Fit fit() const;
  [[nodiscard]] double clock_for(Watts most, const std::vector<double>& clocks_hz) const;
  [[nodiscard]] Watts most_power(double below_trip_k) const;

  PowerCost computer_;
  RecursiveLeastSquares<3> solver_;
  double window_s_;
  std::optional<double> trip_c_{};
  double temperature_c_{};
  double last_hz_{std::numeric_limits<double>::infinity()};  ///< The last answer.
  double busy_cores_{};                                      ///< Mean of some seconds.
  MissionTime last_{};
  MissionTime begun_{};
  double begun_c_{};
  double energy_j_{};  ///< Of the window so far.
  double excess_k_s_{};
};

}  // namespace flyball
