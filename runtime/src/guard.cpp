// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/guard.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {

double safe_speed(double deceleration_m_s2, double delta_s, double distance_m) {
  FLYBALL_ASSERT(deceleration_m_s2 > 0.0, "a=%g", deceleration_m_s2);
  // Comparisons that are false for what is not a number, so that it stops the vehicle, too.
  if (!(distance_m > 0.0) || !(delta_s >= 0.0) || !std::isfinite(delta_s)) {
    return 0.0;
  }
  // eq. 2, multiplied out: its own form subtracts two nearly equal numbers when delta is large
  const double root = std::sqrt(delta_s * delta_s + 2.0 * distance_m / deceleration_m_s2);
  return 2.0 * distance_m / (root + delta_s);
}

double known_free_distance(const OccupancyView& map,
                           const PathSpan& span,
                           const Cylinder& body,
                           double step_m) {
  FLYBALL_ASSERT(step_m > 0.0, "step_m=%g", step_m);
  const Path& path = *span.path;
  if (path.empty()) {
    return 0.0;
  }
  const double start_m = std::clamp(span.from_m, 0.0, path.length_m());
  const double reach_m = std::max(0.0, std::min(span.horizon_m, path.length_m() - start_m));
  double free_m = 0.0;  // the last place known to be free: between two samples nothing is assumed
  for (int i = 0;; ++i) {
    const double ahead_m = std::min(i * step_m, reach_m);
    if (map.body_state(path.at(start_m + ahead_m).p_W, body) != CellState::free) {
      return free_m;
    }
    free_m = ahead_m;
    if (ahead_m >= reach_m) {
      return free_m;
    }
  }
}

double Guard::cruise_speed(Duration latency_bound, double distance_m) const {
  if (latency_bound <= Duration::zero() || latency_bound >= longest_duration) {
    return 0.0;
  }
  return safe_speed(settings_.max_deceleration_m_s2, to_seconds(latency_bound + reaction_time()),
                    distance_m);
}

bool Guard::must_brake(double speed_m_s, double known_free_now_m) const {
  const double reaction_m = speed_m_s * to_seconds(reaction_time());
  const double braking_m = speed_m_s * speed_m_s / (2.0 * settings_.max_deceleration_m_s2);
  return !(reaction_m + braking_m <= known_free_now_m);  // True for what is not a number.
}

void LatencyWindow::add(Duration latency) {
  recent_[added_ % recent_.size()] = latency;
  ++added_;
}

Duration LatencyWindow::bound() const {
  if (added_ == 0) {
    return seed_;
  }
  const std::size_t count = std::min(added_, recent_.size());
  const Duration worst = *std::max_element(recent_.begin(), recent_.begin() + count);
  return worst + worst / 10;
}

}  // namespace flyball
