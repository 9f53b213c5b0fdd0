// SPDX-License-Identifier: BSD-3-Clause
#include "visual/dead_reckoning.h"

#include "flyball/runtime/atmosphere.h"

#include <algorithm>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto memory = 5s;  // A frame that is older than this corrects with what is left.

}  // namespace

void DeadReckoning::start(const Pose& X_WB) {
  samples_.clear();
  fix_ = std::nullopt;
  q_WB_then_ = std::nullopt;
  climb_ = {};
  has_barometer_ = false;
  X_WB_start_ = X_WB;
}

void DeadReckoning::correct(const VisualFix& fix) {
  if (!fix.tracked) {
    return;
  }
  fix_ = fix;
  q_WB_then_ = std::nullopt;
  if (samples_.empty()) {
    return;
  }
  const Sample& then = sample_at(fix.captured);
  height_then_m_ = then.height_m;
  if (then.stamp >= fix.captured) {
    q_WB_then_ = then.q_WB;
  }
}

void DeadReckoning::add_sample(const NavigationSample& sample) {
  if (sample.pressure_pa > 0.0) {
    climb_.update(pressure_height_m(sample.pressure_pa), sample.stamp);
    height_then_m_ = has_barometer_ ? height_then_m_ : climb_.height_m();
    has_barometer_ = true;
  }
  samples_.push_back({sample.stamp, sample.q_WB_ahrs.normalized(), climb_.height_m()});
  if (fix_ && !q_WB_then_ && sample.stamp >= fix_->captured) {
    q_WB_then_ = samples_.back().q_WB;
  }
  while (samples_.front().stamp + memory < sample.stamp) {
    samples_.pop_front();
  }
}

const DeadReckoning::Sample& DeadReckoning::sample_at(MissionTime t) const {
  const auto after =
      std::lower_bound(samples_.begin(), samples_.end(), t,
                       [](const Sample& sample, MissionTime time) { return sample.stamp < time; });
  return after == samples_.end() ? samples_.back() : *after;
}

/// A barometer's noise of 3 cm against the error of a fix's speed: the height is the barometer's.
Pose DeadReckoning::pose_at(MissionTime t) const {
  Pose X_WB = fix_ ? fix_->X_WB : X_WB_start_;
  if (samples_.empty()) {
    return X_WB;
  }
  const double z_then_m = X_WB.translation().z();
  const Sample& then = sample_at(t);
  if (fix_) {
    const double age_s = to_seconds(t - fix_->captured);
    X_WB.translation() += std::clamp(age_s, 0.0, longest_reckoning_s) * fix_->v_WB;
    const Eigen::Quaterniond turned = q_WB_then_.value_or(then.q_WB).conjugate() * then.q_WB;
    X_WB.linear() =
        (Eigen::Quaterniond{fix_->X_WB.linear()} * turned).normalized().toRotationMatrix();
  }
  if (has_barometer_) {
    X_WB.translation().z() = z_then_m + then.height_m - height_then_m_;
  }
  return X_WB;
}

PoseEstimate DeadReckoning::estimate(const NavigationSample& sample) {
  add_sample(sample);
  PoseEstimate estimate{sample.stamp, pose_at(sample.stamp), Vec3::Zero()};
  if (fix_ && to_seconds(sample.stamp - fix_->captured) < longest_reckoning_s) {
    estimate.v_WB = fix_->v_WB;
  } else if (has_barometer_) {
    estimate.v_WB.z() = climb_.climb_m_s();
  }
  return estimate;
}

}  // namespace flyball
