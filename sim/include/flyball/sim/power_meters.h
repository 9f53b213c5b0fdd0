// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the meters on board make of the true power, charge and heat. Policies see these and never
/// the truth.

#include "flyball/runtime/random.h"
#include "flyball/runtime/units.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace flyball {

/// The input rail of a companion computer, as the board's own code reads it: ten times a second
/// from an INA3221, whose step is 40 uV over 10 mOhm at 19 V on a Jetson TX2, averaged over the
/// last second.
class PowerMonitor {
 public:
  static constexpr double step_w = 0.076;
  static constexpr double reading_s = 0.1;

  /// Drew this much for `dt_s`. @pre `dt_s >= 0`.
  void add(Watts power, double dt_s);
  /// Mean of the newest ten readings, or of as many as there are; 0 before the first.
  [[nodiscard]] Watts power() const { return mean_; }

 private:
  std::array<double, 10> readings_w_{};
  std::size_t readings_{};
  double energy_j_{};  ///< Since the last reading, over `time_s_`.
  double time_s_{};
  Watts mean_{};
};

/// An autopilot's power module, and what it tells of the battery once a second (SYS_STATUS of
/// MAVLink: whole per cents).
class PowerModule {
 public:
  static constexpr double message_s = 1.0;
  static constexpr double gain_sigma = 0.01;   ///< A hall sensor's +-3 %, taken as three sigma.
  static constexpr double noise_sigma = 0.02;  ///< Of one message: the motors' switching. Chosen.

  /// Until the first message it shows a vehicle that stands there. The sensor's gain is drawn here,
  /// once a flight.
  PowerModule(double battery_percent, std::uint64_t seed);

  /// `dt_s` later the rotors draw this much and the battery has this charge. @pre `dt_s >= 0`.
  void add(Watts rotors, double battery_percent, double dt_s);
  /// As of the newest message.
  [[nodiscard]] Watts rotor_power() const { return rotors_; }
  [[nodiscard]] double battery_percent() const { return percent_; }

 private:
  RandomStream noise_;
  double gain_;
  double since_s_{};  ///< The newest message.
  Watts rotors_{};
  double percent_;
};

/// A thermal zone of a Jetson TX2 counts in half degrees.
[[nodiscard]] double thermal_zone_c(double temperature_c);

}  // namespace flyball
