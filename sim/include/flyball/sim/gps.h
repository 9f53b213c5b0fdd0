// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// GPS receiver: geodetic fixes with white noise on a slowly wandering bias.

#include "flyball/runtime/messages.h"
#include "flyball/runtime/random.h"
#include "flyball/sim/vehicle.h"

#include <cstdint>
#include <optional>

namespace flyball {

struct GpsSpec {
  double rate_hz{10.0};
  double white_noise_m{0.05};  ///< RTK-class by default; 1.5 for a plain receiver.
  double wander_m{0.10};       ///< Standard deviation of the bias.
  double wander_time_s{60.0};  ///< Its correlation time (first-order Gauss-Markov).
  double velocity_noise_m_s{0.05};
};

struct Geodetic {
  double latitude_rad{};
  double longitude_rad{};
  double height_m{};  ///< Above the WGS-84 ellipsoid.
};

/// East-north-up around `origin` to the WGS-84 ellipsoid; the tangent plane, not a flat earth:
/// exact to 1 um within 100 km.
[[nodiscard]] Geodetic geodetic_of(const Vec3& p_W, const GeodeticOrigin& origin);

class Gps {
 public:
  Gps(const GpsSpec& spec, const GeodeticOrigin& origin, std::uint64_t seed);
  /// One sample of the navigation sensors; `with_fix` adds a GPS fix.
  /// The orientation is passed on as it is: an AHRS is part of the flight controller.
  [[nodiscard]] NavigationSample sample(const VehicleState& state, MissionTime now, bool with_fix);

 private:
  GpsSpec spec_;
  GeodeticOrigin origin_;
  RandomStream noise_;
  Vec3 bias_W_{Vec3::Zero()};
  std::optional<MissionTime> last_fix_{};
};

}  // namespace flyball
