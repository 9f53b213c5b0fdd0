// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/target_follower.h"

#include "flyball/flight/people/person_range.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double max_yaw_rate_rad_s = 1.5707963267948966;  // MAVBench: 90 degrees/s
// Tuned by hand on the walk in the park, at the highest operating point.
constexpr Pid::Gains distance_gains{1.0, 0.1, 0.2, 6.0};
constexpr Pid::Gains yaw_gains{2.0, 0.0, 0.1, max_yaw_rate_rad_s};
// alpha is chosen for boxes that jitter by some pixels. It is meant for frames 50 ms apart; a
// longer gap counts as several frames. beta = alpha^2 / (2 - alpha) weighs noise against lag
// (Benedict and Bordner 1962, IRE Transactions on Automatic Control 7(4)).
constexpr double alpha_of_frame = 0.2;
constexpr double nominal_frame_s = 0.05;
constexpr double fastest_person_m_s = 5.0;
// Nobody keeps a direction for long, so the expected velocity decays with this time constant.
// Chosen: 14 of 15 flights succeeded. With 3 s, and with trackers that count only while a detector
// confirms them, 12 did.
constexpr double keeps_going_s = 2.0;
// Chosen: the search flies as near as the camera still shows somebody standing there in full, at
// the speed of a runner.
constexpr double search_from_m = 4.0;
constexpr double search_speed_m_s = 3.0;
// Chosen: a measurement counts if the person can have gone to its place in the time since the last
// one. The estimate may be wrong by 2 m itself.
constexpr double wrong_by_m = 2.0;
constexpr double reach_m_s = 4.0;
constexpr double most_reach_m = 6.0;
constexpr double candidate_lasts_s = 1.5;  // At the highest clock, three detections or more.

Vec3 direction_L(const Target& target, double x_px, double y_px) {
  const Intrinsics& camera = target.frame.camera;
  const Vec3 ray_C{(x_px - camera.centre_x_px) / camera.focal_px,
                   (y_px - camera.centre_y_px) / camera.focal_px, 1.0};
  return (target.frame.X_LC.linear() * ray_C).normalized();
}

}  // namespace

double Pid::update(double error, double dt_s) {
  const double slope = last_ && dt_s > 0.0 ? (error - *last_) / dt_s : 0.0;
  last_ = error;
  const double wish = gains_.proportional * error + integral_ + gains_.derivative * slope;
  if (std::abs(wish) < gains_.limit) {
    integral_ += gains_.integral * error * dt_s;
  }
  return std::clamp(wish, -gains_.limit, gains_.limit);
}

void Pid::reset() {
  integral_ = 0.0;
  last_.reset();
}

TargetFollower::TargetFollower(const FollowSettings& settings)
    : settings_{settings}, distance_pid_{distance_gains}, yaw_pid_{yaw_gains} {
  gimbal_.tilt_rad =
      std::atan2(settings.height_m - 0.5 * settings.person_height_m, settings.distance_m);
}

void TargetFollower::start(const PoseEstimate& pose) {
  p_W_ = pose.X_WB.translation();
  yaw_rad_ = yaw_of(pose.X_WB.linear().col(0));
}

std::optional<TargetFollower::Measurement> TargetFollower::measured(
    const Target& target, const PoseEstimate& pose) const {
  if (!target.box || (seen_ && target.frame.captured <= *seen_)) {
    return std::nullopt;
  }
  const Vec3 middle_L = direction_L(target, target.box->centre_x_px(), target.box->centre_y_px());
  const PersonRange range =
      person_range(*target.box, target.frame,
                   {settings_.person_height_m, pose.X_WB.translation().z() - settings_.ground_z_m});
  // The size of a box is wrong by up to a tenth; its middle is more exact.
  const double away_m = range.by_ground_m.value_or(range.by_size_m);
  const Vec3 out_L = middle_L * (away_m / middle_L.head<2>().norm());
  return Measurement{level_frame(pose.X_WB) * out_L, target.frame.captured};
}

bool TargetFollower::can_be_at(const Measurement& measured) const {
  const double dt_s = to_seconds(measured.at - *seen_);
  const double reach_m = std::min(wrong_by_m + reach_m_s * dt_s, most_reach_m);
  return (measured.place_W - foreseen(dt_s)).norm() <= reach_m;
}

bool TargetFollower::is_repeated(const Measurement& measured) const {
  const double dt_s = candidate_ ? to_seconds(measured.at - candidate_->at) : 0.0;
  return candidate_ && dt_s > 0.0 && dt_s <= candidate_lasts_s &&
         (measured.place_W - candidate_->place_W).norm() <= wrong_by_m + reach_m_s * dt_s;
}

void TargetFollower::tracked(const Target& target, const PoseEstimate& pose) {
  const auto measurement = measured(target, pose);
  if (measurement && seen_ && can_be_at(*measurement)) {
    believe(*measurement);
  }
}

void TargetFollower::detected(const Target& target, const PoseEstimate& pose) {
  const auto measurement = measured(target, pose);
  if (!measurement) {
    return;
  }
  if (seen_ && can_be_at(*measurement)) {
    believe(*measurement);
  } else if (!seen_ || is_repeated(*measurement)) {
    begin_at(*measurement);
  } else {
    candidate_ = measurement;
  }
}

void TargetFollower::begin_at(const Measurement& measured) {
  seen_ = measured.at;
  person_W_ = measured.place_W;
  v_person_W_ = Vec3::Zero();
  candidate_.reset();
}

void TargetFollower::believe(const Measurement& measured) {
  const double dt_s = to_seconds(measured.at - *seen_);
  if (dt_s > settings_.coast_s) {
    begin_at(measured);
    return;
  }
  seen_ = measured.at;
  const Vec3 foreseen_W = foreseen(dt_s);
  const Vec3 surprise = measured.place_W - foreseen_W;
  const double alpha = 1.0 - std::pow(1.0 - alpha_of_frame, dt_s / nominal_frame_s);
  const double beta = alpha * alpha / (2.0 - alpha);
  person_W_ = foreseen_W + alpha * surprise;
  v_person_W_ += beta / dt_s * surprise;
  v_person_W_.z() = 0.0;
  if (v_person_W_.norm() > fastest_person_m_s) {
    v_person_W_ *= fastest_person_m_s / v_person_W_.norm();
  }
}

Vec3 TargetFollower::foreseen(double after_s) const {
  return person_W_ + keeps_going_s * (1.0 - std::exp(-after_s / keeps_going_s)) * v_person_W_;
}

void TargetFollower::point_at(const Vec3& person_W) {
  const Vec3 out_W = person_W - p_W_;
  gimbal_.pan_rad = wrap_angle(yaw_of(out_W) - yaw_rad_);
  gimbal_.tilt_rad = std::atan2(-out_W.z(), out_W.head<2>().norm());
}

/// Changes the velocity towards the wished one within the limit of acceleration.
void TargetFollower::steer(const Vec3& wish_W, double dt_s, Setpoint& setpoint) {
  const Vec3 change = wish_W - v_W_;
  const double largest = settings_.max_acceleration_m_s2 * dt_s;
  const double share = change.norm() > largest ? largest / change.norm() : 1.0;
  setpoint.a_WB = change * (share / dt_s);
  p_W_ += dt_s * v_W_ + 0.5 * dt_s * dt_s * setpoint.a_WB;
  v_W_ += share * change;
  setpoint.p_WB = p_W_;
  setpoint.v_WB = v_W_;
}

void TargetFollower::face(const Vec3& place_W, double dt_s, Setpoint& setpoint) {
  setpoint.yaw_rate_rad_s = yaw_pid_.update(wrap_angle(yaw_of(place_W - p_W_) - yaw_rad_), dt_s);
  point_at(place_W);
}

Vec3 TargetFollower::follow(double age_s, double dt_s, Setpoint& setpoint) {
  const Vec3 foreseen_W = foreseen(age_s);
  const Vec3 v_foreseen_W = std::exp(-age_s / keeps_going_s) * v_person_W_;
  Vec3 out_W = foreseen_W - p_W_;
  out_W.z() = 0.0;
  const double away_m = std::max(out_W.norm(), 1e-3);
  const double speed_m_s = distance_pid_.update(away_m - settings_.distance_m, dt_s);
  const Vec3 wish_W = v_foreseen_W + out_W * (speed_m_s / away_m);
  face(foreseen_W, dt_s, setpoint);
  side_ = std::copysign(1.0, out_W.x() * v_person_W_.y() - out_W.y() * v_person_W_.x());
  return wish_W * std::min(settings_.max_speed_m_s / std::max(wish_W.norm(), 1e-3), 1.0);
}

Vec3 TargetFollower::search(MissionTime now, double dt_s, Setpoint& setpoint) {
  distance_pid_.reset();
  if (!seen_ || settings_.search_rate_rad_s <= 0.0) {
    yaw_pid_.reset();
    return Vec3::Zero();
  }
  if (candidate_ && to_seconds(now - candidate_->at) < candidate_lasts_s) {
    face(candidate_->place_W, dt_s, setpoint);
    return Vec3::Zero();
  }
  const Vec3 place_W = foreseen(settings_.coast_s);
  Vec3 out_W = place_W - p_W_;
  out_W.z() = 0.0;
  const double away_m = std::max(out_W.norm(), 1e-3);
  if (away_m > search_from_m + 1.0) {
    face(place_W, dt_s, setpoint);
  } else {
    yaw_pid_.reset();
    setpoint.yaw_rate_rad_s = side_ * settings_.search_rate_rad_s;
    gimbal_.pan_rad = 0.0;
    gimbal_.tilt_rad =
        std::atan2(settings_.height_m - 0.5 * settings_.person_height_m, settings_.distance_m);
  }
  return out_W * (std::clamp(away_m - search_from_m, 0.0, search_speed_m_s) / away_m);
}

Setpoint TargetFollower::tick(MissionTime now, Duration period, double limit_m_s) {
  const double dt_s = to_seconds(period);
  // Not below 0, where a camera's clock is ahead: what decays with age would grow.
  const double age_s = seen_ ? std::max(0.0, to_seconds(now - *seen_)) : settings_.coast_s;
  Setpoint setpoint;
  setpoint.stamp = now;
  Vec3 wish_W =
      age_s < settings_.coast_s ? follow(age_s, dt_s, setpoint) : search(now, dt_s, setpoint);
  if (wish_W.norm() > limit_m_s && limit_m_s < settings_.max_speed_m_s) {
    wish_W *= limit_m_s / wish_W.norm();
  }
  yaw_rad_ = wrap_angle(yaw_rad_ + setpoint.yaw_rate_rad_s * dt_s);
  steer(wish_W, dt_s, setpoint);
  setpoint.yaw_rad = yaw_rad_;
  return setpoint;
}

}  // namespace flyball
