// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/setpoint_stream.h"

namespace flyball {
namespace {

using namespace std::chrono_literals;

// PX4 wants 2 Hz at least, and its guide names 20 to 50 (docs.px4.io, Offboard Mode).
constexpr auto stream_period = 20ms;
constexpr auto setpoint_loss = 500ms;  // Before PX4 itself gives up, after 1 s as it is shipped.

}  // namespace

void SetpointStream::end() {
  motion_ = Motion::none;
  sent_.reset();
}

void SetpointStream::start(const VehicleMotion& vehicle, Duration now) {
  reference_ = {};
  reference_.p_WB = vehicle.X_WB.translation();
  reference_.v_WB = vehicle.v_WB;
  reference_.yaw_rad = sent_ ? sent_->yaw_rad : yaw_of(vehicle.X_WB.linear().col(0));
  last_ = now;
}

void SetpointStream::stop(const VehicleMotion& vehicle, Duration now) {
  start(vehicle, now);
  motion_ = Motion::stop;
}

void SetpointStream::climb(const VehicleMotion& vehicle, double height_m, Duration now) {
  start(vehicle, now);
  reference_.v_WB = Vec3::Zero();
  height_m_ = height_m;
  motion_ = Motion::climb;
}

void SetpointStream::follow(const Setpoint& setpoint) {
  newest_ = setpoint;
  motion_ = Motion::follow;
}

void SetpointStream::move(double dt_s) {
  if (dt_s <= 0.0) {
    return;
  }
  const Vec3 before = reference_.v_WB;
  if (motion_ == Motion::climb) {
    climb_reference(reference_, height_m_, dt_s);
  } else {
    brake_reference(reference_, dt_s);
  }
  move_reference(reference_, before, dt_s);
}

std::optional<Setpoint> SetpointStream::due(Duration now, const VehicleMotion& vehicle) {
  if (motion_ == Motion::none || (next_ && now < *next_ && *next_ - now <= stream_period)) {
    return std::nullopt;
  }
  // In step with the period, but never several at once after a pause.
  next_ = next_ && now - *next_ < stream_period ? *next_ + stream_period : now + stream_period;
  if (motion_ == Motion::follow && now - newest_.stamp.time_since_epoch() > setpoint_loss) {
    stop(vehicle, now);
  }
  if (motion_ == Motion::follow) {
    sent_ = extrapolated(newest_, to_seconds(now - newest_.stamp.time_since_epoch()));
  } else {
    move(to_seconds(now - last_));
    last_ = now;
    sent_ = reference_;
  }
  return sent_;
}

}  // namespace flyball
