// SPDX-License-Identifier: BSD-3-Clause
#include "visual/standstill.h"

#include "visual/motion.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto pause = 500ms;
constexpr double rest_px = 0.5;  // Lucas-Kanade's noise is .1 to .3 px.
constexpr std::size_t enough = 10;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void RestWatch::clear() {
  then_.clear();
}

void RestWatch::begin(const std::vector<TrackedPoint>& points, MissionTime now) {
  then_.clear();
  for (const TrackedPoint& point : points) {
    then_[point.id] = point.ray;
  }
  captured_then_ = told_ = now;
}

std::optional<SlowView> RestWatch::compare(const std::vector<TrackedPoint>& points,
                                           MissionTime now,
                                           double focal_px) {
  std::vector<double> moved;
  std::vector<double> depths_m;
  for (const TrackedPoint& point : points) {
    const auto before = then_.find(point.id);
    if (before != then_.end()) {
      moved.push_back((point.ray - before->second).norm());
      if (point.depth_m) {
        depths_m.push_back(*point.depth_m);
      }
    }
  }
  if (moved.size() < enough) {
    begin(points, now);
    return std::nullopt;
  }
  if (now - told_ < pause) {
    return std::nullopt;
  }
  SlowView view{median(moved), to_seconds(now - captured_then_), 0.0};
  if (!depths_m.empty()) {
    view.depth_m = median(depths_m);
  }
  told_ = now;
  if (view.moved_ray * focal_px > rest_px) {
    begin(points, now);
  }
  return view;
}

double shaking(const std::deque<Vec3>& recent_f_B) {
  if (recent_f_B.size() < shake_samples) {
    return 0.0;
  }
  Vec3 mean = Vec3::Zero();
  for (const Vec3& f : recent_f_B) {
    mean += f / static_cast<double>(recent_f_B.size());
  }
  double squares = 0.0;
  for (const Vec3& f : recent_f_B) {
    squares += (f - mean).squaredNorm() / 3.0;
  }
  return std::sqrt(squares / static_cast<double>(recent_f_B.size()));
}

Innovation standing(const InertialFilter& filter,
                    const ImuSample& sample,
                    double speed_sigma_m_s,
                    double shaking_m_s2) {
  constexpr double rate_sigma_rad_s = 0.01;
  constexpr double accel_sigma_m_s2 = 0.2;
  Innovation still;
  still.residual = Eigen::VectorXd::Zero(9);
  still.slope = Eigen::MatrixXd::Zero(9, filter.size());
  still.sigma = Eigen::VectorXd::Zero(9);
  const Vec3 up_B = filter.X_WB().linear().transpose() * -gravity_W();
  still.residual.segment<3>(0) = -filter.v_WB();
  still.residual.segment<3>(3) = sample.w_WB_B - filter.gyro_bias_now();
  still.residual.segment<3>(6) = sample.f_B - filter.accel_bias_now() - up_B;
  using F = InertialFilter;
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  still.slope.block<3, 3>(0, F::velocity) = one;
  still.slope.block<3, 3>(3, F::gyro_bias) = one;
  still.slope.block<3, 3>(6, F::accel_bias) = one;
  still.slope.block<3, 3>(6, F::rotation) = skew(up_B);  // up_B turns with B: + up_B x r.
  still.sigma.segment<3>(0).setConstant(speed_sigma_m_s);
  still.sigma.segment<3>(3).setConstant(rate_sigma_rad_s);
  still.sigma.segment<3>(6).setConstant(std::hypot(accel_sigma_m_s2, shaking_m_s2));
  return still;
}

Innovation slow(const InertialFilter& filter, double speed_sigma_m_s) {
  Innovation measured{-filter.v_WB(), Eigen::MatrixXd::Zero(3, filter.size()),
                      Eigen::VectorXd::Constant(3, speed_sigma_m_s)};
  measured.slope.block<3, 3>(0, InertialFilter::velocity) = Eigen::Matrix3d::Identity();
  return measured;
}

}  // namespace flyball
