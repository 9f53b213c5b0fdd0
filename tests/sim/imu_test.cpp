// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/imu.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double interval_s = 0.005;

ImuSpec silent() {
  ImuSpec spec;
  spec.gyro_rad_s_rthz = spec.accel_m_s2_rthz = 0.0;
  spec.gyro_walk_rad_s2_rthz = spec.accel_walk_m_s3_rthz = 0.0;
  spec.gyro_bias_rad_s = spec.accel_bias_m_s2 = spec.vibration_m2_s4 = 0.0;
  return spec;
}

std::vector<ImuSample> felt(const ImuSpec& spec, const VehicleState& state, int count) {
  Imu imu{spec, 7};
  std::vector<ImuSample> samples;
  for (int i = 0; i < count; ++i) {
    samples.push_back(imu.sample(state, MissionTime{from_seconds(interval_s * i)}));
  }
  return samples;
}

struct Spread {
  Vec3 mean{Vec3::Zero()};
  Vec3 variance{Vec3::Zero()};
};

template <class Part>
Spread spread(const std::vector<ImuSample>& samples, Part part) {
  Spread of;
  const auto count = static_cast<double>(samples.size());
  for (const ImuSample& sample : samples) {
    of.mean += part(sample) / count;
  }
  for (const ImuSample& sample : samples) {
    of.variance += (part(sample) - of.mean).cwiseAbs2() / count;
  }
  return of;
}

const auto force = [](const ImuSample& s) { return s.f_B; };
const auto turning = [](const ImuSample& s) { return s.w_WB_B; };

TEST(Imu, feels_that_it_does_not_fall) {
  VehicleState tilted;
  tilted.X_WB.linear() = Eigen::AngleAxisd{0.3, Vec3::UnitY()}.toRotationMatrix();
  const ImuSample sample = felt(silent(), tilted, 1).front();
  EXPECT_LT((sample.f_B - 9.80665 * Vec3{-std::sin(0.3), 0.0, std::cos(0.3)}).norm(), 1e-9);
  EXPECT_EQ(sample.w_WB_B, Vec3::Zero());
}

TEST(Imu, feels_nothing_in_free_fall_but_its_turning) {
  VehicleState falling;
  falling.a_WB = Vec3{0.0, 0.0, -9.80665};
  falling.w_WB_B = Vec3{0.1, -0.2, 0.3};
  const ImuSample sample = felt(silent(), falling, 1).front();
  EXPECT_LT(sample.f_B.norm(), 1e-9);
  EXPECT_EQ(sample.w_WB_B, falling.w_WB_B);
}

// 4000 samples: the variance of white noise comes out within 3 sqrt(2 / 4000) = 7 %.
TEST(Imu, has_white_noise_of_the_given_density) {
  ImuSpec spec = silent();
  spec.gyro_rad_s_rthz = 2e-4;
  spec.accel_m_s2_rthz = 3e-3;
  const auto samples = felt(spec, {}, 4000);
  const Vec3 gyro = spread(samples, turning).variance;
  const Vec3 accel = spread(samples, force).variance;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(gyro[axis] / (4e-8 * 200.0), 1.0, 0.07);
    EXPECT_NEAR(accel[axis] / (9e-6 * 200.0), 1.0, 0.07);
  }
}

TEST(Imu, has_a_bias_that_wanders) {
  ImuSpec spec = silent();
  spec.gyro_bias_rad_s = 0.01;
  const auto samples = felt(spec, {}, 10);
  EXPECT_GT(samples.front().w_WB_B.norm(), 1e-3);
  EXPECT_EQ(samples.front().w_WB_B, samples.back().w_WB_B);
  spec.gyro_walk_rad_s2_rthz = 1e-3;
  const auto wandering = felt(spec, {}, 2000);
  const double away = (wandering.back().w_WB_B - wandering.front().w_WB_B).norm();
  EXPECT_GT(away, 1e-3) << "sqrt(10 s) * 1e-3, three axes: 5.5e-3 is usual";
  EXPECT_LT(away, 2e-2);
}

TEST(Imu, shakes_in_hover_as_was_measured_and_four_times_as_hard_at_1_4_times_the_speed) {
  ImuSpec spec = silent();
  spec.vibration_m2_s4 = 9.46;
  VehicleState hovering;
  hovering.rotor_rev_s = {60.3, 61.7, 60.9, 61.2};
  const Spread slow = spread(felt(spec, hovering, 8000), force);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(slow.variance[axis], 9.46, 1.0);
  }
  EXPECT_NEAR(slow.mean.z(), 9.80665, 0.05);
  for (double& speed : hovering.rotor_rev_s) {
    speed *= std::sqrt(2.0);
  }
  const Spread fast = spread(felt(spec, hovering, 8000), force);
  EXPECT_NEAR(fast.variance.x() / slow.variance.x(), 4.0, 0.6);
  EXPECT_LT(spread(felt(spec, {}, 100), force).variance.norm(), 1e-12) << "rotors at rest";
}

TEST(Imu, is_the_same_for_the_same_seed) {
  EXPECT_EQ(felt({}, {}, 5).back().f_B, felt({}, {}, 5).back().f_B);
  Imu other{{}, 8};
  EXPECT_NE(other.sample({}, {}).f_B, felt({}, {}, 1).back().f_B);
}

}  // namespace
}  // namespace flyball
