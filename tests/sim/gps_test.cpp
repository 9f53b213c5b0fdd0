// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/gps.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double a_m = 6378137.0;          // WGS-84
constexpr double b_m = 6356752.314245179;  // WGS-84

/// The forward direction is closed form, so it is the judge: geodetic to earth-centred, from the
/// ellipsoid's two axes.
Vec3 earth_centred(double latitude, double longitude, double height_m) {
  const double ac = a_m * std::cos(latitude);
  const double bs = b_m * std::sin(latitude);
  const double root = std::hypot(ac, bs);
  const double axial = a_m * a_m / root * std::cos(latitude) + height_m * std::cos(latitude);
  return {axial * std::cos(longitude), axial * std::sin(longitude),
          b_m * b_m / root * std::sin(latitude) + height_m * std::sin(latitude)};
}

Vec3 east_north_up(const Geodetic& g, const GeodeticOrigin& o) {
  const Vec3 d = earth_centred(g.latitude_rad, g.longitude_rad, g.height_m) -
                 earth_centred(o.latitude_rad, o.longitude_rad, o.height_m);
  // Turns the earth until the origin lies on the x axis: up, east and north are then x, y and z.
  const Vec3 turned = Eigen::AngleAxisd(o.latitude_rad, Vec3::UnitY()) *
                      (Eigen::AngleAxisd(-o.longitude_rad, Vec3::UnitZ()) * d);
  return {turned.y(), turned.z(), turned.x()};
}

TEST(Gps, geodetic_inverts_the_ellipsoid_within_a_micrometre) {
  const GeodeticOrigin origins[] = {{}, {-1.2, 2.9, -20.0}, {0.0, 0.0, 0.0}, {1.5, -3.1, 4000.0}};
  for (const GeodeticOrigin& origin : origins) {
    for (const Vec3& p_W :
         {Vec3{0, 0, 0}, Vec3{1e4, -3e3, 500}, Vec3{-7e3, 9e3, -50}, Vec3{6e4, 8e4, 1e3}}) {
      EXPECT_LT((east_north_up(geodetic_of(p_W, origin), origin) - p_W).norm(), 1e-6 + 1e-9)
          << p_W.transpose() << " at " << origin.latitude_rad;
    }
  }
}

TEST(Gps, one_metre_north_is_the_meridians_radius) {
  const GeodeticOrigin origin;
  const double e2 = 1.0 - b_m * b_m / (a_m * a_m);
  const double s = std::sin(origin.latitude_rad);
  const double meridian_m = a_m * (1.0 - e2) / std::pow(1.0 - e2 * s * s, 1.5) + origin.height_m;
  const Geodetic north = geodetic_of({0.0, 1.0, 0.0}, origin);
  EXPECT_NEAR((north.latitude_rad - origin.latitude_rad) * meridian_m, 1.0, 1e-6);
  EXPECT_NEAR(north.longitude_rad, origin.longitude_rad, 1e-15);
}

VehicleState at(const Vec3& p_W) {
  VehicleState state;
  state.X_WB.translation() = p_W;
  state.X_WB.linear() = Eigen::AngleAxisd(0.7, Vec3{0.6, 0.0, 0.8}).toRotationMatrix();
  state.v_WB = {1.0, -2.0, 0.5};
  state.w_WB_B = {0.1, 0.2, 0.3};
  return state;
}

Vec3 fix_error(const NavigationSample& sample,
               const VehicleState& state,
               const GeodeticOrigin& origin) {
  return east_north_up({sample.latitude_rad, sample.longitude_rad, sample.height_m}, origin) -
         state.X_WB.translation();
}

TEST(Gps, a_receiver_without_noise_gives_the_truth) {
  GpsSpec spec;
  spec.white_noise_m = spec.wander_m = spec.velocity_noise_m_s = 0.0;
  const GeodeticOrigin origin;
  Gps gps{spec, origin, 1};
  const VehicleState state = at({120.0, -40.0, 7.0});
  const NavigationSample sample = gps.sample(state, MissionTime{std::chrono::seconds{3}}, true);
  EXPECT_TRUE(sample.has_fix);
  EXPECT_LT(fix_error(sample, state, origin).norm(), 1e-6);
  EXPECT_EQ(sample.v_gps_W, state.v_WB);
  EXPECT_EQ(sample.stamp, MissionTime{std::chrono::seconds{3}});
  EXPECT_LT(sample.q_WB_ahrs.angularDistance(Eigen::Quaterniond{state.X_WB.linear()}), 1e-12);
}

TEST(Gps, samples_without_a_fix_carry_none_and_disturb_nothing) {
  Gps often{{}, {}, 7};
  Gps rarely{{}, {}, 7};
  const VehicleState state = at({1.0, 2.0, 3.0});
  MissionTime now{};
  for (int i = 0; i < 50; ++i, now += std::chrono::milliseconds{10}) {
    const bool with_fix = i % 10 == 0;
    const NavigationSample a = often.sample(state, now, with_fix);
    EXPECT_EQ(a.has_fix, with_fix);
    EXPECT_LT(a.q_WB_ahrs.angularDistance(Eigen::Quaterniond{state.X_WB.linear()}), 1e-12);
    if (with_fix) {
      const NavigationSample b = rarely.sample(state, now, true);
      EXPECT_EQ(a.latitude_rad, b.latitude_rad);
      EXPECT_EQ(a.height_m, b.height_m);
      EXPECT_EQ(a.v_gps_W, b.v_gps_W);
    }
  }
}

/// Variance and lag-one correlation over one second of the bias alone, in all three axes.
struct Wander {
  double variance_m2{};
  double correlation{};
};

Wander wander_at(double rate_hz) {
  GpsSpec spec;
  spec.white_noise_m = spec.velocity_noise_m_s = 0.0;
  spec.wander_m = 2.0;
  spec.wander_time_s = 5.0;
  const GeodeticOrigin origin;
  const VehicleState state = at(Vec3::Zero());
  double sum2 = 0.0;
  double product = 0.0;
  int samples = 0;
  Gps gps{spec, origin, 11};
  Vec3 last = Vec3::Zero();
  const int per_second = static_cast<int>(rate_hz);
  for (int i = 0; i < 20000 * per_second; ++i) {
    const MissionTime now{std::chrono::nanoseconds{i * (1000000000LL / per_second)}};
    const NavigationSample sample = gps.sample(state, now, true);
    if (i % per_second != 0) {
      continue;
    }
    const Vec3 bias = fix_error(sample, state, origin);
    sum2 += bias.squaredNorm();
    product += bias.dot(last);
    last = bias;
    samples += 3;
  }
  return {sum2 / samples, product / sum2};
}

TEST(Gps, bias_is_gauss_markov_whatever_the_rate_of_fixes) {
  for (const double rate_hz : {1.0, 4.0}) {
    const Wander wander = wander_at(rate_hz);
    // 20 000 s hold 6000 independent draws in three axes: 4 sigma of the variance is 7 %.
    EXPECT_NEAR(wander.variance_m2, 4.0, 0.07 * 4.0) << rate_hz;
    EXPECT_NEAR(wander.correlation, std::exp(-1.0 / 5.0), 0.02) << rate_hz;
  }
}

TEST(Gps, white_noise_has_the_declared_deviation) {
  GpsSpec spec;
  spec.wander_m = 0.0;
  spec.white_noise_m = 1.5;
  spec.velocity_noise_m_s = 0.2;
  const GeodeticOrigin origin;
  Gps gps{spec, origin, 5};
  const VehicleState state = at(Vec3::Zero());
  double position = 0.0;
  double velocity = 0.0;
  constexpr int fixes = 5000;
  for (int i = 0; i < fixes; ++i) {
    const NavigationSample sample =
        gps.sample(state, MissionTime{std::chrono::milliseconds{100 * i}}, true);
    position += fix_error(sample, state, origin).squaredNorm() / (3.0 * fixes);
    velocity += (sample.v_gps_W - state.v_WB).squaredNorm() / (3.0 * fixes);
  }
  // 15 000 draws: 4 sigma of a standard deviation is 2.3 %.
  EXPECT_NEAR(std::sqrt(position), 1.5, 0.023 * 1.5);
  EXPECT_NEAR(std::sqrt(velocity), 0.2, 0.023 * 0.2);
}

TEST(Gps, seeds_differ_and_repeat) {
  const VehicleState state = at(Vec3::Zero());
  const double a = Gps({}, {}, 1).sample(state, {}, true).latitude_rad;
  EXPECT_EQ(a, Gps({}, {}, 1).sample(state, {}, true).latitude_rad);
  EXPECT_NE(a, Gps({}, {}, 2).sample(state, {}, true).latitude_rad);
}

}  // namespace
}  // namespace flyball
