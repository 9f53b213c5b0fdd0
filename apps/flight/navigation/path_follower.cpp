// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/path_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr double middle_m_s = 4.0;  // Chosen: between slow flight, 1 m/s, and cruise, 8 to 10 m/s.
// Half of what the guard may brake with; the rest is for curves and for the guard.
constexpr double comfort_m_s2 = 3.0;
// A planned stop brakes harder, a little less than the guard would: the later the vehicle must
// stop before an obstacle, the more room is left to turn.
constexpr double stopping_m_s2 = 5.0;
constexpr double yaw_rate_rad_s = 1.5707963267948966;  // MAVBench: 90 degrees a second.
// Chosen by hand: where the camera looks along the path, and how far before the end of known-free
// space the vehicle stops.
constexpr double look_ahead_s = 1.0;
constexpr double look_ahead_min_m = 1.0;
constexpr double stop_margin_m = 0.1;
constexpr double look_aside_rad = 0.8;  // To both sides, when the vehicle has stalled.
constexpr double look_aside_after_s = 2.0;
constexpr double standing_m_s = 0.02;
constexpr double at_end_m = 0.01;    // Chosen: small beside every tracking tube.
constexpr double arrival_m = 0.3;    // Chosen: from here a vehicle brakes that flies at 1 m/s.
constexpr double facing_rad = 0.05;  // Chosen: a small part of a camera's field.
constexpr double range_reserve_m =
    2.0;                               // The cells of the farthest returns reach beyond the range.
constexpr auto odometer_memory = 10s;  // Chosen: an older map would stop the vehicle anyway.

double towards(double value, double target, double braking_m_s2, double dt_s) {
  return value < target ? std::min(target, value + comfort_m_s2 * dt_s)
                        : std::max(target, value - braking_m_s2 * dt_s);
}

// The safe speed jumps up when a map arrives and falls until the next one. A vehicle that followed
// each of these changes at full acceleration would pitch up and down and lose height, so the speed
// follows with a time constant of .2 s. The guard does not wait for this.
double eased(double value, double target, double dt_s) {
  constexpr double gain_1_s = 5.0;  // Chosen: a few times slower than 20 maps a second.
  return value + std::min(1.0, gain_1_s * dt_s) * (target - value);
}

}  // namespace

TierDistances tier_speeds_m_s(const KnobsInForce& knobs) {
  const double knob = knobs.value("mission.max_speed_m_s");
  return {std::min(slow_m_s, knob), std::min(middle_m_s, knob), knob};
}

TierDistances known_free_until_m(const OccupancyView& map,
                                 const Path& path,
                                 double s_m,
                                 const Brief& brief,
                                 const KnobsInForce& knobs) {
  // The steps are half a cell of the usual finest map, .15 m. Nothing is known beyond the range.
  constexpr double step_m = 0.075;
  const double horizon_m =
      brief.maps_obstacles ? knobs.value("map.range_m") + range_reserve_m : path.length_m();
  const TierDistances speeds_m_s = tier_speeds_m_s(knobs);
  TierDistances until_m{};
  for (std::size_t tier = 0; tier < speed_tiers; ++tier) {
    const Cylinder body = brief.body_at(speeds_m_s[tier]);
    until_m[tier] = s_m + known_free_distance(map, {&path, s_m, horizon_m}, body, step_m);
  }
  return until_m;
}

PathFollower::PathFollower(std::shared_ptr<const Brief> brief)
    : brief_{std::move(brief)}, guard_{guard_settings(brief_->settings)} {}

void PathFollower::hover_at(const Vec3& p_W, double yaw_rad) {
  path_ = std::make_shared<const Path>();
  hover_W_ = p_W;
  yaw_rad_ = yaw_rad;
  s_m_ = speed_m_s_ = target_m_s_ = stop_at_m_ = 0.0;
  free_until_m_ = {};
  stall_.reset();
  looked_s_ = 0.0;
}

void PathFollower::pick_up_at(const Vec3& p_W) {
  constexpr double step_m = 0.1;
  constexpr double behind_m = 20.0;  // Chosen: a stop from 10 m/s, and what a search flies back.
  speed_m_s_ = target_m_s_ = 0.0;
  stall_.reset();
  double nearest_m = std::numeric_limits<double>::infinity();
  const double last_m = s_m_;
  for (double s_m = last_m; s_m >= std::max(0.0, last_m - behind_m); s_m -= step_m) {
    if (const double m = (path_->at(s_m).p_W - p_W).norm(); m < nearest_m) {
      nearest_m = m;
      s_m_ = s_m;
    }
  }
}

SpeedProfile PathFollower::profile_of(const Path& path, double braking_m_s2) const {
  SpeedProfileLimits limits;
  limits.lateral_m_s2 = comfort_m_s2;
  limits.lag_s = brake_lag_s();
  limits.longitudinal_m_s2 = std::min(braking_m_s2, guard_.settings().max_deceleration_m_s2);
  return {path, limits, [this](const Vec3& p_W) { return speed_limit_at(p_W); }};
}

bool PathFollower::adopt(const Path& tail, double splice_m) {
  constexpr double rounding_m = 1e-6;
  if (has_path() && s_m_ > splice_m + rounding_m) {
    return false;
  }
  Path path = has_path() ? Path::joined(*path_, s_m_, splice_m, tail) : tail;
  constexpr double slack_m_s = 0.1;  // Chosen: the follower brakes by this in one tick.
  if (profile_of(path, stopping_m_s2).at(0.0) + slack_m_s < speed_m_s_) {
    return false;
  }
  profile_ = profile_of(path, comfort_m_s2);
  path_ = std::make_shared<const Path>(std::move(path));
  s_m_ = 0.0;
  stop_at_m_ = path_->length_m();
  stall_.reset();
  looked_s_ = 0.0;
  return true;
}

void PathFollower::commit_stop(double s_m) {
  stop_at_m_ = std::clamp(s_m, s_m_, path_->length_m());
}

void PathFollower::refresh_known_free(const OccupancyView& map) {
  if (has_path()) {
    free_until_m_ = known_free_until_m(map, *path_, s_m_, *brief_, *knobs_);
  }
}

double PathFollower::distance_since(MissionTime captured) const {
  const auto after =
      std::lower_bound(odometer_.begin(), odometer_.end(), captured,
                       [](const auto& entry, MissionTime t) { return entry.first < t; });
  return after == odometer_.end() ? 0.0 : travelled_m_ - after->second;
}

// The distance is limited to what the newest frame itself can have seen, because the map remembers
// free space beyond its range, and something may have moved there since. In a flight without a map,
// space that is declared clear stays clear.
double PathFollower::room_m(std::size_t tier) const {
  const double from_here_m = free_until_m_[tier] - s_m_;
  if (!brief_->maps_obstacles) {
    return from_here_m;
  }
  const double range_m = std::min(knobs_->value("map.range_m"), longest_range_m_);
  const double in_range_m = range_m - brief_->body_at(tier_speeds_m_s(*knobs_)[tier]).radius_m;
  return std::min(from_here_m + distance_since(newest_capture_), in_range_m);
}

// In a flight without a map the vehicle need not wait for one, so its latency does not count.
double PathFollower::cruise_speed(std::size_t tier) const {
  const double safe_m_s = brief_->maps_obstacles
                              ? guard_.cruise_speed(latency_bound(), room_m(tier))
                              : safe_speed(guard_.settings().max_deceleration_m_s2,
                                           to_seconds(guard_.reaction_time()), room_m(tier));
  return std::min(tier_speeds_m_s(*knobs_)[tier], safe_m_s);
}

Duration PathFollower::latency_bound() const {
  const double factor = knobs_->restraint.bound_factor;
  const Duration bound =
      factor == 1.0 ? latency_bound_ : from_seconds(factor * to_seconds(latency_bound_));
  return std::min(bound, longest_latency_bound);
}

bool PathFollower::is_held() const {
  return must_stop_ || knobs_->restraint.must_hover;
}

double PathFollower::safe_cruise() const {
  if (is_held()) {
    return 0.0;
  }
  double safe = 0.0;
  for (std::size_t tier = 0; tier < free_until_m_.size(); ++tier) {
    safe = std::max(safe, cruise_speed(tier));
  }
  return safe;
}

double PathFollower::brake_lag_s() const {
  return to_seconds(guard_.settings().brake_lag);
}

double PathFollower::stopping() const {
  return std::min(stopping_m_s2, guard_.settings().max_deceleration_m_s2);
}

double PathFollower::speed_limit() const {
  const double stop = safe_speed(stopping(), brake_lag_s(), stop_at_m_ - s_m_);
  return std::min(profile_.at(s_m_), stop);
}

// When the free space of a tier ends, the vehicle brakes to the speed of the next slower tier, and
// from the slowest tier to a stop.
double PathFollower::braked_speed(double dt_s) const {
  const auto speeds = tier_speeds_m_s(*knobs_);
  const double least = speed_m_s_ - guard_.settings().max_deceleration_m_s2 * dt_s;
  for (std::size_t tier = 0; tier < speeds.size(); ++tier) {
    const double floor = tier == 0 ? 0.0 : speeds[tier - 1];
    if (speed_m_s_ > floor && guard_.must_brake(speed_m_s_, free_until_m_[tier] - s_m_)) {
      return std::max(floor, least);
    }
  }
  return speed_m_s_ + comfort_m_s2 * dt_s;
}

// When the vehicle has left its tube, the reference waits for it by slowing down to a crawl. A lag
// along the path is no danger, and waiting for every lag would make the two oscillate.
double PathFollower::wait_for_vehicle(const Vec3& error_W) const {
  const Vec3 tangent_W = path_->at(s_m_).tangent_W;
  const double along_m = error_W.dot(tangent_W);
  const double across_m = (error_W - along_m * tangent_W).norm();
  const double tube_m = brief_->tube.radius_m(speed_m_s_);
  constexpr double patience_m = 0.2;  // Chosen: so far outside, the reference is slowest.
  constexpr double lag_m = 0.5;       // Chosen: the lag of .07 s at 7 m/s.
  constexpr double slowest = 0.1;     // Chosen: above zero, so that no error stops the flight.
  const double out_m = std::max(across_m - tube_m, std::abs(along_m) - lag_m);
  return std::clamp(1.0 - out_m / patience_m, slowest, 1.0);
}

// The last centimetre is for braking alone: with the latency of a map as reaction time, the speed
// falls as the distance does, and would never quite reach zero.
double PathFollower::next_speed(double dt_s, const Vec3& error_W) {
  if (stop_at_m_ - s_m_ < at_end_m) {
    target_m_s_ = 0.0;
    return towards(speed_m_s_, target_m_s_, stopping(), dt_s);
  }
  const double braking = guard_.settings().max_deceleration_m_s2;
  const double waiting = wait_for_vehicle(error_W);
  const double cruise = waiting * safe_cruise();
  const double limit = waiting * speed_limit();
  target_m_s_ = std::min(cruise, limit);
  const double eased_m_s = eased(speed_m_s_, cruise, dt_s);
  const double wished = towards(speed_m_s_, std::min(eased_m_s, limit), braking, dt_s);
  return std::min(wished, braked_speed(dt_s));
}

PathReference PathFollower::tick(MissionTime now, Duration dt, const Vec3& error_W) {
  const double dt_s = to_seconds(dt);
  double acceleration = 0.0;
  if (has_path()) {
    const double next = next_speed(dt_s, error_W);
    acceleration = (next - speed_m_s_) / dt_s;
    const double moved =
        std::min(0.5 * (next + speed_m_s_) * dt_s, std::max(0.0, stop_at_m_ - s_m_));
    s_m_ += moved;
    travelled_m_ += moved;
    speed_m_s_ = next;
  }
  turn(now, dt_s);
  note_standstill(now);
  odometer_.emplace_back(now, travelled_m_);
  while (odometer_.front().first + odometer_memory < now) {
    odometer_.pop_front();
  }
  return {s_m_, speed_m_s_, acceleration, yaw_rad_};
}

// The camera looks where the path goes next, at least one metre ahead. So a vehicle turns in place
// before it flies out of its own field of view.
std::optional<double> PathFollower::wanted_yaw_rad(MissionTime now) {
  const double ahead_m = std::max(look_ahead_min_m, look_ahead_s * speed_m_s_);
  Vec3 direction = path_->at(s_m_ + ahead_m).p_W - path_->at(s_m_).p_W;
  direction.z() = 0.0;
  if (direction.norm() <= 0.1) {
    return std::nullopt;
  }
  // A vehicle that has stalled before unknown space looks left and right of it.
  const double stalled_s = std::max(0.0, to_seconds(stalled(now)) - look_aside_after_s);
  return yaw_of(direction) + look_aside_rad * std::sin(stalled_s);
}

void PathFollower::turn(MissionTime now, double dt_s) {
  if (looks_for_way()) {
    look_for_way(*wants_way_to_W_, dt_s);
  } else if (face_yaw_rad_ && (stands_still() || arrives())) {
    turn_towards(*face_yaw_rad_, dt_s);
  } else if (has_path()) {
    turn_along_path(dt_s, now);
  }
}

// Nothing is left to be looked at on the way, which is known to be free to its end.
bool PathFollower::arrives() const {
  return path_->length_m() - s_m_ < arrival_m && stop_at_m_ == path_->length_m() &&
         free_until_m_.front() > path_->length_m() - at_end_m;
}

void PathFollower::turn_towards(double yaw_rad, double dt_s) {
  const double error = wrap_angle(yaw_rad - yaw_rad_);
  yaw_rad_ =
      wrap_angle(yaw_rad_ + std::clamp(error, -yaw_rate_rad_s * dt_s, yaw_rate_rad_s * dt_s));
}

// What lies in the way was perhaps seen in large cells, or not at all: it is looked at again.
void PathFollower::look_for_way(const Vec3& to_W, double dt_s) {
  const Vec3 direction_W = to_W - position_W();
  looked_s_ += dt_s;
  if (direction_W.head<2>().norm() > 0.1) {
    turn_towards(yaw_of(direction_W) + look_aside_rad * std::sin(looked_s_), dt_s);
  }
}

void PathFollower::turn_along_path(double dt_s, MissionTime now) {
  if (const auto wanted_rad = wanted_yaw_rad(now)) {
    turn_towards(*wanted_rad, dt_s);
    const bool faces_path = std::abs(wrap_angle(*wanted_rad - yaw_rad_)) < facing_rad;
    if (stall_ && !stall_->faces_path_since && faces_path) {
      stall_->faces_path_since = now;
    }
  }
}

bool PathFollower::looks_for_way() const {
  return wants_way_to_W_ && speed_m_s_ <= standing_m_s;
}

void PathFollower::note_standstill(MissionTime now) {
  const bool stands = speed_m_s_ <= standing_m_s;
  if (!stands || stands_still() || is_held()) {
    stall_.reset();
  } else if (!stall_) {
    stall_ = Stall{now, std::nullopt};
  }
}

Vec3 PathFollower::position_W() const {
  return has_path() ? path_->at(s_m_).p_W : hover_W_;
}

TrackingError PathFollower::tracking_error(const Vec3& error_W) const {
  const Vec3 tangent_W = has_path() ? path_->at(s_m_).tangent_W : Vec3{Vec3::Zero()};
  const double behind_m = error_W.dot(tangent_W);
  const Vec3 across_W = error_W - behind_m * tangent_W;
  return {error_W.norm(), across_W.head<2>().norm(), -error_W.z(), -behind_m};
}

double PathFollower::stop_point_m(double deceleration_m_s2) const {
  const double v = speed_m_s_;
  return s_m_ + v * to_seconds(guard_.settings().tick) + v * v / (2.0 * deceleration_m_s2);
}

// The stop leaves room for the wide tube, so that the next path can be flown at speed from its
// start. It is never nearer than the vehicle can stop with full braking.
double PathFollower::planned_stop_m() const {
  const double limit_m_s2 = guard_.settings().max_deceleration_m_s2;
  const double wished = stop_point_m(stopping()) + speed_m_s_ * brake_lag_s();
  const double wide = free_until_m_.back() - stop_margin_m;
  const double reach = wide > s_m_ ? wide : free_until_m_.front();
  return std::max(std::min(wished, reach), stop_point_m(limit_m_s2));
}

double PathFollower::farthest_stop_m() const {
  return std::min(path_->length_m(), free_until_m_.back() - stop_margin_m);
}

bool PathFollower::is_at_end() const {
  return has_path() && speed_m_s_ == 0.0 && path_->length_m() - s_m_ < at_end_m;
}

Duration PathFollower::stalled(MissionTime now) const {
  return stall_ ? now - stall_->since : Duration{0};
}

std::optional<MissionTime> PathFollower::faces_path_since() const {
  return stall_ ? stall_->faces_path_since : std::nullopt;
}

}  // namespace flyball
