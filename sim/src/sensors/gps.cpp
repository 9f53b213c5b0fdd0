// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/gps.h"

#include "sensors/normal3.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// WGS-84, NIMA TR8350.2: the two defining lengths; e2 is the first eccentricity squared.
constexpr double semi_major_m = 6378137.0;
constexpr double flattening = 1.0 / 298.257223563;
constexpr double e2 = flattening * (2.0 - flattening);

/// Radius of curvature in the prime vertical.
double prime_vertical_m(double latitude_rad) {
  const double s = std::sin(latitude_rad);
  return semi_major_m / std::sqrt(1.0 - e2 * s * s);
}

Vec3 earth_centred(const GeodeticOrigin& o) {
  const double n = prime_vertical_m(o.latitude_rad);
  const double axial = (n + o.height_m) * std::cos(o.latitude_rad);
  return {axial * std::cos(o.longitude_rad), axial * std::sin(o.longitude_rad),
          (n * (1.0 - e2) + o.height_m) * std::sin(o.latitude_rad)};
}

/// East, north and up in earth-centred axes.
Eigen::Matrix3d axes_at(const GeodeticOrigin& o) {
  const double sin_lat = std::sin(o.latitude_rad);
  const double cos_lat = std::cos(o.latitude_rad);
  const double sin_lon = std::sin(o.longitude_rad);
  const double cos_lon = std::cos(o.longitude_rad);
  Eigen::Matrix3d axes;
  axes.col(0) = Vec3{-sin_lon, cos_lon, 0.0};
  axes.col(1) = Vec3{-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat};
  axes.col(2) = Vec3{cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};
  return axes;
}

/// Fixed-point iteration on the latitude: each round gains a factor of e2, about 150, so the six
/// rounds go far below rounding everywhere but at the poles' axis.
Geodetic geodetic_from_centre(const Vec3& p) {
  const double axial = std::hypot(p.x(), p.y());
  double latitude = std::atan2(p.z(), axial * (1.0 - e2));
  for (int round = 0; round < 6; ++round) {
    const double n = prime_vertical_m(latitude);
    latitude = std::atan2(p.z() + e2 * n * std::sin(latitude), axial);
  }
  const double s = std::sin(latitude);
  // Height along the normal, written without a division by cos(latitude).
  const double height =
      axial * std::cos(latitude) + p.z() * s - semi_major_m * std::sqrt(1.0 - e2 * s * s);
  return {latitude, std::atan2(p.y(), p.x()), height};
}

}  // namespace

Geodetic geodetic_of(const Vec3& p_W, const GeodeticOrigin& origin) {
  return geodetic_from_centre(earth_centred(origin) + axes_at(origin) * p_W);
}

Gps::Gps(const GpsSpec& spec, const GeodeticOrigin& origin, std::uint64_t seed)
    : spec_{spec}, origin_{origin}, noise_{seed, "gps"} {
  bias_W_ = spec_.wander_m * normal3(noise_);  // Stationary from the first fix on.
}

NavigationSample Gps::sample(const VehicleState& state, MissionTime now, bool with_fix) {
  NavigationSample sample;
  sample.stamp = now;
  sample.q_WB_ahrs = Eigen::Quaterniond{state.X_WB.linear()};
  if (!with_fix) {
    return sample;
  }
  if (last_fix_) {
    // First-order Gauss-Markov, exact for any interval.
    const double kept =
        std::exp(-to_seconds(now - *last_fix_) / std::max(1e-9, spec_.wander_time_s));
    bias_W_ = kept * bias_W_ + spec_.wander_m * std::sqrt(1.0 - kept * kept) * normal3(noise_);
  }
  last_fix_ = now;
  const Vec3 measured_W =
      state.X_WB.translation() + bias_W_ + spec_.white_noise_m * normal3(noise_);
  const Geodetic fix = geodetic_of(measured_W, origin_);
  sample.has_fix = true;
  sample.latitude_rad = fix.latitude_rad;
  sample.longitude_rad = fix.longitude_rad;
  sample.height_m = fix.height_m;
  sample.v_gps_W = state.v_WB + spec_.velocity_noise_m_s * normal3(noise_);
  return sample;
}

}  // namespace flyball
