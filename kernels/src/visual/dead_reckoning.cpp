// SPDX-License-Identifier: BSD-3-Clause
#include "visual/dead_reckoning.h"

#include <algorithm>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto memory = 5s;         // A frame that is older than this corrects with what is left.
constexpr double coasting_s = 0.5;  // At 5 m/s^2 the speed is wrong by 2.5 m/s by then.

}  // namespace

void DeadReckoning::start(const Pose& X_WB) {
  attitudes_.clear();
  fix_ = std::nullopt;
  X_WB_start_ = X_WB;
}

void DeadReckoning::correct(const VisualFix& fix) {
  if (fix.tracked) {
    fix_ = fix;
  }
}

Eigen::Quaterniond DeadReckoning::attitude_at(MissionTime t) const {
  const auto after = std::lower_bound(
      attitudes_.begin(), attitudes_.end(), t,
      [](const Attitude& attitude, MissionTime time) { return attitude.stamp < time; });
  return after == attitudes_.end() ? attitudes_.back().q_WB : after->q_WB;
}

PoseEstimate DeadReckoning::estimate(const NavigationSample& sample) {
  attitudes_.push_back({sample.stamp, sample.q_WB_ahrs.normalized()});
  while (attitudes_.front().stamp + memory < sample.stamp) {
    attitudes_.pop_front();
  }
  PoseEstimate estimate{sample.stamp, X_WB_start_, Vec3::Zero()};
  if (!fix_) {
    return estimate;
  }
  const double age_s = to_seconds(sample.stamp - fix_->captured);
  estimate.v_WB = age_s < coasting_s ? fix_->v_WB : Vec3::Zero();
  estimate.X_WB = fix_->X_WB;
  estimate.X_WB.translation() += std::clamp(age_s, 0.0, coasting_s) * fix_->v_WB;
  const Eigen::Quaterniond turned =
      attitude_at(fix_->captured).conjugate() * attitudes_.back().q_WB;
  estimate.X_WB.linear() =
      (Eigen::Quaterniond{fix_->X_WB.linear()} * turned).normalized().toRotationMatrix();
  return estimate;
}

}  // namespace flyball
