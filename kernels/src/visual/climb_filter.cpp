// SPDX-License-Identifier: BSD-3-Clause
#include "visual/climb_filter.h"

#include <cmath>

namespace flyball {
namespace {

constexpr double acceleration_m_s2 = 2.0;  // What a multirotor does upwards, as white noise.
constexpr double noise_m = 0.1;            // Of one sample.
constexpr double longest_gap_s = 0.1;      // After a longer one it begins anew.

struct Gains {
  double alpha{};
  double beta{};
};

Gains steady_gains(double interval_s) {
  const double index = acceleration_m_s2 * interval_s * interval_s / noise_m;
  const double root = 0.25 * (4.0 + index - std::sqrt(8.0 * index + index * index));
  const double alpha = 1.0 - root * root;
  return {alpha, 2.0 * (2.0 - alpha) - 4.0 * std::sqrt(1.0 - alpha)};
}

}  // namespace

void ClimbFilter::update(double height_m, MissionTime now) {
  const double interval_s = last_ ? to_seconds(now - *last_) : 0.0;
  last_ = now;
  if (interval_s <= 0.0 || interval_s > longest_gap_s) {
    height_m_ = height_m;
    climb_m_s_ = 0.0;
    return;
  }
  const Gains gains = steady_gains(interval_s);
  const double predicted_m = height_m_ + interval_s * climb_m_s_;
  const double off_m = height_m - predicted_m;
  height_m_ = predicted_m + gains.alpha * off_m;
  climb_m_s_ += gains.beta / interval_s * off_m;
}

}  // namespace flyball
