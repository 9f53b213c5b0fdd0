// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/barometer.h"

#include "flyball/runtime/atmosphere.h"

#include <algorithm>
#include <cmath>

namespace flyball {

Barometer::Barometer(const BarometerSpec& spec, double origin_height_m, std::uint64_t seed)
    : spec_{spec}, origin_height_m_{origin_height_m}, noise_{seed, "barometer"} {
  bias_pa_ = spec_.wander_pa * noise_.normal();  // Stationary from the first sample on.
}

double Barometer::sample(double z_W_m, MissionTime now) {
  if (last_) {
    const double kept = std::exp(-to_seconds(now - *last_) / std::max(1e-9, spec_.wander_time_s));
    bias_pa_ = kept * bias_pa_ + spec_.wander_pa * std::sqrt(1.0 - kept * kept) * noise_.normal();
  }
  last_ = now;
  return standard_pressure_pa(origin_height_m_ + z_W_m) + bias_pa_ +
         spec_.white_noise_pa * noise_.normal();
}

}  // namespace flyball
