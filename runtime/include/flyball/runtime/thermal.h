// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Heat: how warm a computer gets from its own power, and which clocks it then still grants.

#include "flyball/runtime/units.h"

#include <optional>
#include <vector>

namespace flyball {

/// From `at_c` on, and until it is cooler than `at_c - hysteresis_k`, clocks end at `cap`.
struct ThermalTrip {
  double at_c{};
  double hysteresis_k{};
  Hertz cap{};
};

/// One heat capacity behind one thermal resistance to the air:
///
///     tau dT/dt = T_air + R P - T,    tau = R C
struct ThermalModel {
  double ambient_c{25.0};
  double resistance_k_w{1.0};
  double time_constant_s{60.0};
  std::vector<ThermalTrip> trips{};  ///< Ascending.
};

/// The temperature of one computer, and the trips that are active.
class ThermalState {
 public:
  /// Begins where `before`, drawn for ever, would have brought it.
  /// @pre Resistance and time constant are positive.
  ThermalState(const ThermalModel& model, Watts before);

  /// `power` was drawn for `dt_s`. Exact for a constant power: the step may be of any length.
  void step(Watts power, double dt_s);
  /// Another wind, or none: the heat capacity stays, so the time constant follows the resistance.
  /// @pre `resistance_k_w > 0`.
  void set_cooling(double ambient_c, double resistance_k_w);
  void set_temperature(double temperature_c);

  [[nodiscard]] double temperature_c() const { return temperature_c_; }
  [[nodiscard]] double hottest_c() const { return hottest_c_; }
  /// The lowest cap of the active trips; empty while none is.
  [[nodiscard]] std::optional<Hertz> cap() const;
  /// Where clocks are lost first [degrees Celsius]; empty: nowhere.
  [[nodiscard]] std::optional<double> first_trip_c() const;
  [[nodiscard]] const ThermalModel& model() const { return model_; }

 private:
  void look_at_trips();

  ThermalModel model_;
  double capacity_j_k_;
  double temperature_c_;
  double hottest_c_;
  std::vector<bool> active_;  ///< In the order of the trips.
};

}  // namespace flyball
