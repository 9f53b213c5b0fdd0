// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Barometer: the pressure around the vehicle, with noise and a bias that wanders.

#include "flyball/runtime/random.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <optional>

namespace flyball {

struct BarometerSpec {
  double white_noise_pa{1.2};   ///< MS5611, data sheet: .012 mbar rms; a decimetre.
  double wander_pa{12.0};       ///< Standard deviation of the bias: a metre, an assumption.
  double wander_time_s{300.0};  ///< Its correlation time (first-order Gauss-Markov).
};

class Barometer {
 public:
  /// @param origin_height_m  Of W's origin above the sea.
  Barometer(const BarometerSpec& spec, double origin_height_m, std::uint64_t seed);

  /// Pressure [Pa] at a height [m] in W, in a standard atmosphere. Calls in order of time.
  [[nodiscard]] double sample(double z_W_m, MissionTime now);

 private:
  BarometerSpec spec_;
  double origin_height_m_;
  RandomStream noise_;
  double bias_pa_{};
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
