// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/wind.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double foot_m = 0.3048;
constexpr double lowest_ft = 10.0;  // The model's range of heights.
constexpr double highest_ft = 1000.0;
// In still air a hovering vehicle would stay in one gust for ever; real ones turn over.
constexpr double least_airspeed_m_s = 1.0;
constexpr double root3 = 1.7320508075688772;

}  // namespace

GustScale gust_scale(double height_m, double wind_20ft_m_s) {
  const double h = std::clamp(height_m / foot_m, lowest_ft, highest_ft);
  const double shape = 0.177 + 0.000823 * h;
  GustScale scale;
  scale.vertical_m = h * foot_m;                                // L_w = h
  scale.level_m = h / std::pow(shape, 1.2) * foot_m;            // L_u = h / (.177 + .000823 h)^1.2
  scale.vertical_m_s = 0.1 * wind_20ft_m_s;                     // sigma_w = .1 W20
  scale.level_m_s = scale.vertical_m_s / std::pow(shape, 0.4);  // sigma_u / sigma_w
  return scale;
}

// Dryden's transverse filter (1 + sqrt3 tau s) / (1 + tau s)^2 in steps of theta = dt / tau: with
// fast' = -fast + noise, slow' = -slow + fast and y = slow + sqrt3 slow', whose variance is 1 for
// white noise of intensity 1. Stationary covariance of (fast, slow): (1/2, 1/4; 1/4, 1/4).
void Wind::Transverse::start(RandomStream& noise) {
  const double a = noise.normal();
  fast = std::sqrt(0.5) * a;
  slow = (0.25 / std::sqrt(0.5)) * a + std::sqrt(0.25 - 0.125) * noise.normal();
}

void Wind::Transverse::pass(double lengths, RandomStream& noise) {
  // Exact for every step: what the step adds is the stationary covariance less what is left of it.
  const double theta = lengths;
  const double decay = std::exp(-theta);
  const double decay2 = decay * decay;
  const double q11 = 0.5 * (1.0 - decay2);
  const double q12 = 0.25 * (1.0 - decay2) - 0.5 * theta * decay2;
  const double q22 = 0.25 * (1.0 - decay2) - 0.5 * theta * (1.0 + theta) * decay2;
  const double a = noise.normal();
  const double b = noise.normal();
  const double l11 = std::sqrt(q11);
  const double l21 = l11 > 0.0 ? q12 / l11 : 0.0;
  slow = decay * (slow + theta * fast) + l21 * a + std::sqrt(std::max(0.0, q22 - l21 * l21)) * b;
  fast = decay * fast + l11 * a;
}

double Wind::Transverse::value() const {
  return slow + root3 * (fast - slow);
}

Wind::Wind(const WindSpec& spec, std::uint64_t seed)
    : spec_{spec}, noise_{seed, "wind"}, velocity_W_{spec.mean_W} {
  Vec3 level_W = spec.mean_W;
  level_W.z() = 0.0;
  if (level_W.norm() > 0.0) {
    along_W_ = level_W.normalized();
  }
  along_ = noise_.normal();
  across_.start(noise_);
  up_.start(noise_);
}

void Wind::advance(double dt_s, double height_m, const Vec3& v_WB) {
  if (spec_.gust_wind_m_s <= 0.0) {
    return;
  }
  const GustScale scale = gust_scale(height_m, spec_.gust_wind_m_s);
  const double way_m = dt_s * std::max((v_WB - spec_.mean_W).norm(), least_airspeed_m_s);
  const double decay = std::exp(-way_m / scale.level_m);
  along_ = decay * along_ + std::sqrt(1.0 - decay * decay) * noise_.normal();
  across_.pass(way_m / scale.level_m, noise_);
  up_.pass(way_m / scale.vertical_m, noise_);
  const Vec3 across_W = Vec3::UnitZ().cross(along_W_);
  velocity_W_ = spec_.mean_W + scale.level_m_s * (along_ * along_W_ + across_.value() * across_W) +
                scale.vertical_m_s * up_.value() * Vec3::UnitZ();
}

}  // namespace flyball
