// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/localization_watch.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// Chosen by hand.
constexpr double stop_s = 1.5;  // A stop from 6 m/s at 5 m/s^2 takes 1.2 s.
constexpr double look_s = 6.0;  // To look left, right and ahead again.
constexpr double look_aside_rad =
    1.0471975511965976;                 // 60 degrees: with a field of view of 90, 210 in all.
constexpr double back_m = 3.0;          // Flown back along the own track.
constexpr double back_speed_m_s = 1.0;  // Slower than the flight in which the pose was lost.
constexpr double back_s = back_m / back_speed_m_s + 1.0;
constexpr double patience_s = stop_s + 2.0 * look_s + back_s + 2.0;
constexpr auto longest_silence = 2s;  // Eight frames at the lowest rate that a policy may choose.
constexpr double trail_step_m = 0.1;
constexpr std::size_t trail_points = 50;  // 5 m, more than is flown back.

double look_aside(double since_s) {
  constexpr double full_turn_rad = 6.283185307179586;
  return look_aside_rad * std::sin(full_turn_rad * std::clamp(since_s / look_s, 0.0, 1.0));
}

}  // namespace

void LocalizationWatch::lose(MissionTime now) {
  lost_since_ = now;
  ++times_lost_;
}

void LocalizationWatch::waited(MissionTime now) {
  if (answered_ && !lost_since_ && now - *answered_ > longest_silence) {
    lose(now);
  }
}

void LocalizationWatch::fixed(MissionTime now, const VisualFix& fix) {
  answered_ = now;
  if (!fix.tracked && !lost_since_) {
    lose(now);
  } else if (fix.tracked && lost_since_) {
    lost_s_ += to_seconds(now - *lost_since_);
    lost_since_.reset();
    search_.reset();
  }
}

bool LocalizationWatch::has_given_up(MissionTime now) const {
  return lost_since_ && to_seconds(now - (search_ ? search_->since : *lost_since_)) > patience_s;
}

void LocalizationWatch::passed(const PoseEstimate& estimate) {
  if (trail_.empty() ||
      (estimate.X_WB.translation() - trail_.back().X_WB.translation()).norm() > trail_step_m) {
    trail_.push_back(estimate);
    if (trail_.size() > trail_points) {
      trail_.pop_front();
    }
  }
}

const PoseEstimate& LocalizationWatch::passed_before(double path_m) const {
  std::size_t i = trail_.size() - 1;
  for (double flown_m = 0.0; i > 0 && flown_m < path_m; --i) {
    flown_m += (trail_[i].X_WB.translation() - trail_[i - 1].X_WB.translation()).norm();
  }
  return trail_[i];
}

std::optional<Setpoint> LocalizationWatch::search(MissionTime now, double height_W_m) {
  if (!lost_since_ || trail_.empty()) {
    return std::nullopt;
  }
  search_ = search_.value_or(Search{now, height_W_m});
  const double since_s = to_seconds(now - search_->since);
  const double back_since_s = since_s - stop_s - look_s;
  const PoseEstimate& at = passed_before(std::clamp(back_since_s * back_speed_m_s, 0.0, back_m));
  Setpoint setpoint;
  setpoint.stamp = now;
  setpoint.p_WB = at.X_WB.translation();
  setpoint.p_WB.z() = search_->height_W_m;
  setpoint.yaw_rad = wrap_angle(yaw_of(at.X_WB.linear().col(0)) + look_aside(since_s - stop_s) +
                                look_aside(back_since_s - back_s));
  return setpoint;
}

LocalizationStatus LocalizationWatch::status(MissionTime now, double height_W_m, bool may_search) {
  if (!may_search) {
    search_.reset();
  }
  return {is_lost(), may_search ? search(now, height_W_m) : std::nullopt, times_lost_,
          lost_s_ + (lost_since_ ? to_seconds(now - *lost_since_) : 0.0)};
}

}  // namespace flyball
