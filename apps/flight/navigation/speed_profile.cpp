// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/speed_profile.h"

#include "flyball/runtime/guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

// A corner (infinite curvature) can only be passed at a standstill, but a reference with v = 0
// would never leave it. So the reference passes a corner at .05 m/s, where even a right angle costs
// only 2 mm of tracking error.
constexpr double crawl_m_s = 0.05;

double curve_speed_squared(double curvature_1_m, const SpeedProfileLimits& limits) {
  const double crawl = crawl_m_s * crawl_m_s;
  if (!std::isfinite(curvature_1_m)) {
    return crawl;
  }
  const double bend = std::max(curvature_1_m, 1e-9);
  const double turning = limits.turn_rad_s / bend;
  return std::max(crawl, std::min(limits.lateral_m_s2 / bend, turning * turning));
}

// The largest speed at `ds_m` before a place that is passed with `speed_m_s`.
double speed_before(double speed_m_s, double ds_m, const SpeedProfileLimits& limits) {
  const double a = limits.longitudinal_m_s2;
  const double to_standstill_m = speed_m_s * speed_m_s / (2.0 * a) + limits.lag_s * speed_m_s;
  return safe_speed(a, limits.lag_s, ds_m + to_standstill_m);
}

}  // namespace

SpeedProfile::SpeedProfile(const Path& path,
                           const SpeedProfileLimits& limits,
                           const std::function<double(const Vec3&)>& place_limit) {
  const auto& samples = path.samples();
  s_m_.resize(samples.size());
  speed_squared_.resize(samples.size());
  double next_s = path.length_m();
  double next_speed = 0.0;
  for (std::size_t i = samples.size(); i-- > 0;) {
    const auto& sample = samples[i];
    const double place = place_limit(sample.p_W);
    const double reachable = speed_before(next_speed, next_s - sample.s_m, limits);
    next_speed =
        std::min({place, std::sqrt(curve_speed_squared(sample.curvature_1_m, limits)), reachable});
    next_s = sample.s_m;
    s_m_[i] = sample.s_m;
    speed_squared_[i] = next_speed * next_speed;
  }
}

double SpeedProfile::at(double s_m) const {
  const auto above = std::upper_bound(s_m_.begin(), s_m_.end(), s_m);
  if (above == s_m_.begin()) {
    return std::sqrt(speed_squared_.front());
  }
  if (above == s_m_.end()) {
    return std::sqrt(speed_squared_.back());
  }
  const auto i = static_cast<std::size_t>(above - s_m_.begin());
  const double u = (s_m - s_m_[i - 1]) / (s_m_[i] - s_m_[i - 1]);
  return std::sqrt((1.0 - u) * speed_squared_[i - 1] + u * speed_squared_[i]);
}

}  // namespace flyball
