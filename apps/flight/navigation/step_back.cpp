// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/step_back.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// Chosen by hand. The vehicle cannot see behind itself, so it flies back slowly and not far.
constexpr double spacing_m = 0.1;      // Between remembered places: less than a fine cell.
constexpr double most_trail_m = 16.0;  // For four looks from elsewhere (Navigator).
constexpr double least_m = 0.2;        // From nearer by the camera would see nothing new.
constexpr double speed_m_s = 0.5;
constexpr double turn_rate_rad_s = 0.8;
constexpr double settled_rad = 0.05;  // To the wanted heading.
constexpr double same_place_m = 3.0;  // Manoeuvres that begin within this are of one place, ...
constexpr int most_times = 3;         // ... from which more of them would show nothing new.

double towards(double value, double target, double most) {
  return value + std::clamp(wrap_angle(target - value), -most, most);
}

}  // namespace

double blind_m(double cell_m, const Cylinder& body, double half_field) {
  FLYBALL_ASSERT(half_field > 0.0, "half_field=%g", half_field);
  return (cell_m + body.half_height_m) / half_field + cell_m - body.radius_m;
}

void StepBack::flew(const Vec3& p_W) {
  if (!trail_W_.empty() && (p_W - trail_W_.back()).norm() < spacing_m) {
    return;
  }
  trail_W_.push_back(p_W);
  if (static_cast<double>(trail_W_.size()) * spacing_m > most_trail_m) {
    trail_W_.pop_front();
  }
}

void StepBack::forget() {
  trail_W_.clear();
  is_active_ = false;
}

bool StepBack::begin(double distance_m, double yaw_rad) {
  if (static_cast<double>(trail_W_.size()) * spacing_m < least_m) {
    return false;
  }
  const Vec3 here_W = trail_W_.back();
  const bool is_same_place = times_ > 0 && (here_W - from_W_).norm() < same_place_m;
  if (is_same_place && times_ >= most_times) {
    return false;
  }
  times_ = is_same_place ? times_ + 1 : 1;
  from_W_ = here_W;
  is_active_ = true;
  left_m_ = std::max(distance_m, least_m);
  yaw_rad_ = yaw_rad;
  settled_.reset();
  return true;
}

void StepBack::begin_goal() {
  times_ = 0;
}

StepBack::Hover StepBack::tick(MissionTime now, Duration dt, const Hover& hover, bool is_at_it) {
  const double dt_s = to_seconds(dt);
  Hover next = hover;
  next.yaw_rad = wrap_angle(towards(hover.yaw_rad, yaw_rad_, turn_rate_rad_s * dt_s));
  double step_m = std::min(left_m_, speed_m_s * dt_s);
  while (step_m > 0.0 && !trail_W_.empty()) {
    const Vec3 to_W = trail_W_.back() - next.p_W;
    const double to_m = to_W.norm();
    const double part_m = std::min(step_m, to_m);
    if (to_m > 0.0) {
      next.p_W += to_W * (part_m / to_m);
    }
    left_m_ -= part_m;
    step_m -= part_m;
    if (part_m == to_m) {
      trail_W_.pop_back();
    }
  }
  const bool is_there = left_m_ <= 0.0 || trail_W_.empty();
  const bool looks_there = std::abs(wrap_angle(yaw_rad_ - next.yaw_rad)) < settled_rad;
  const bool is_settled = is_there && looks_there && is_at_it;
  settled_ = is_settled ? settled_.value_or(now) : std::optional<MissionTime>{};
  return next;
}

bool StepBack::has_looked(MissionTime captured) {
  if (!is_active_ || !settled_ || captured < *settled_) {
    return false;
  }
  is_active_ = false;
  return true;
}

}  // namespace flyball
