// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/localizer.h"

#include "flyball/kernels/kernels.h"
#include "flyball/runtime/registry.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::unique_ptr<Localizer> make(const char* name) {
  Registry registry;
  register_kernels(registry);
  auto localizer = registry.make<Localizer>(name);
  localizer->start(GeodeticOrigin{});
  return localizer;
}

MissionTime at(double t_s) {
  return MissionTime{Duration{std::llround(t_s * 1e9)}};
}

/// A fix near the default origin; exact to 2 mm within 100 m (radii of curvature of WGS-84).
NavigationSample fix_at(double t_s, const Vec3& p_W, const Vec3& v_W) {
  const GeodeticOrigin origin;
  const double e2 = 6.69437999014e-3;
  const double s = std::sin(origin.latitude_rad);
  const double w2 = 1.0 - e2 * s * s;
  const double meridian_m = 6378137.0 * (1.0 - e2) / std::pow(w2, 1.5) + origin.height_m;
  const double normal_m = 6378137.0 / std::sqrt(w2) + origin.height_m;
  NavigationSample sample;
  sample.stamp = at(t_s);
  sample.has_fix = true;
  sample.latitude_rad = origin.latitude_rad + p_W.y() / meridian_m;
  sample.longitude_rad =
      origin.longitude_rad + p_W.x() / (normal_m * std::cos(origin.latitude_rad));
  // The tangent plane leaves the ellipsoid with the square of the distance.
  sample.height_m = origin.height_m + p_W.z() + p_W.head<2>().squaredNorm() / (2.0 * normal_m);
  sample.v_gps_W = v_W;
  return sample;
}

NavigationSample without_fix(double t_s) {
  NavigationSample sample;
  sample.stamp = at(t_s);
  return sample;
}

TEST(Truth, repeats_what_the_simulator_knows) {
  NavigationSample sample;
  sample.stamp = at(4.0);
  TruePose truth;
  truth.X_WB.translation() = Vec3{1, 2, 3};
  truth.v_WB = Vec3{4, 5, 6};
  Work work;
  const auto localizer = make("truth");
  ASSERT_TRUE(localizer->inputs().truth);
  localizer->set_true_pose(truth);
  EXPECT_FALSE(make("truth")->estimate(sample, work)) << "it was not told the true pose";
  const PoseEstimate estimate = localizer->estimate(sample, work).value();
  EXPECT_EQ(estimate.stamp, at(4.0));
  EXPECT_TRUE(estimate.X_WB.isApprox(truth.X_WB));
  EXPECT_EQ(estimate.v_WB, (Vec3{4, 5, 6}));
  EXPECT_EQ(work.count("samples"), 2);
}

TEST(Gps, turns_a_fix_into_east_north_up) {
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{80, 0, 0}, Vec3{0, -60, 0}, Vec3{30, 40, 25}}) {
    Work work;
    const PoseEstimate estimate = make("gps")->estimate(fix_at(0.0, p, Vec3::Zero()), work).value();
    EXPECT_LT((estimate.X_WB.translation() - p).norm(), 0.002) << p.transpose();
    EXPECT_EQ(work.count("samples"), 1);
  }
}

TEST(Gps, carries_the_position_on_between_fixes) {
  const auto gps = make("gps");
  Work work;
  (void)gps->estimate(fix_at(0.0, {10, 0, 5}, {3, 0, -1}), work);
  const PoseEstimate estimate = gps->estimate(without_fix(0.05), work).value();
  EXPECT_LT((estimate.X_WB.translation() - Vec3{10.15, 0, 4.95}).norm(), 0.002);
  EXPECT_EQ(estimate.v_WB, (Vec3{3, 0, -1}));
}

TEST(Gps, takes_the_attitude_of_the_flight_controller) {
  NavigationSample sample = fix_at(0.0, Vec3::Zero(), Vec3::Zero());
  sample.q_WB_ahrs = Eigen::AngleAxisd{0.7, Vec3::UnitZ()} * Eigen::AngleAxisd{0.2, Vec3::UnitX()};
  Work work;
  const PoseEstimate estimate = make("gps")->estimate(sample, work).value();
  EXPECT_TRUE(estimate.X_WB.linear().isApprox(sample.q_WB_ahrs.toRotationMatrix(), 1e-12));
}

TEST(Gps, knows_no_place_until_the_first_fix) {
  const auto gps = make("gps");
  Work work;
  EXPECT_FALSE(gps->estimate(without_fix(0.0), work));
  EXPECT_FALSE(gps->estimate(without_fix(1.0), work));
  const PoseEstimate estimate = gps->estimate(fix_at(2.0, {20, 0, 0}, Vec3::Zero()), work).value();
  EXPECT_LT((estimate.X_WB.translation() - Vec3{20, 0, 0}).norm(), 0.002);
}

TEST(Gps, ignores_a_fix_that_is_not_finite) {
  const auto gps = make("gps");
  Work work;
  (void)gps->estimate(fix_at(0.0, {5, 0, 0}, {1, 0, 0}), work);
  NavigationSample broken = fix_at(0.1, {9, 9, 9}, Vec3::Zero());
  broken.latitude_rad = std::numeric_limits<double>::quiet_NaN();
  const PoseEstimate estimate = gps->estimate(broken, work).value();
  EXPECT_LT((estimate.X_WB.translation() - Vec3{5.1, 0, 0}).norm(), 0.002);
}

// Steady state: for gain k and noise s, white noise leaves s sqrt(k / (2 - k)) = .23 s for k = .1;
// the held velocity's noise adds .05 m/s * .1 s / sqrt(1 - (1 - k)^2) = .0115 m. Per axis, .0162 m.
TEST(Gps, ignores_a_fix_at_a_place_where_no_vehicle_can_be) {
  for (const double height_m : {1e308, 1e150, -2e6}) {
    const auto gps = make("gps");
    Work work;
    (void)gps->estimate(fix_at(0.0, {5, 0, 0}, {1, 0, 0}), work);
    NavigationSample broken = fix_at(0.1, {5, 0, 0}, {1, 0, 0});
    broken.height_m = height_m;
    const PoseEstimate estimate = gps->estimate(broken, work).value();
    EXPECT_LT((estimate.X_WB.translation() - Vec3{5.1, 0, 0}).norm(), 0.01) << height_m;
  }
}

TEST(Gps, averages_the_noise_of_fixes_on_a_moving_vehicle) {
  const auto gps = make("gps");
  std::mt19937 generator{3};
  std::normal_distribution<double> noise{0.0, 0.05};
  const auto noise3 = [&] {
    const double x = noise(generator);
    const double y = noise(generator);
    return Vec3{x, y, noise(generator)};
  };
  Work work;
  double squares = 0.0;
  int samples = 0;
  for (int i = 0; i < 1000; ++i) {
    const double t_s = 0.1 * i;
    const Vec3 v_W{1.0, 0.5, 0.0};
    const Vec3 p_W = t_s * v_W;
    const PoseEstimate estimate =
        gps->estimate(fix_at(t_s, p_W + noise3(), v_W + noise3()), work).value();
    if (i >= 100) {
      squares += (estimate.X_WB.translation() - p_W).squaredNorm() / 3.0;
      ++samples;
    }
  }
  const double rms_m = std::sqrt(squares / samples);
  EXPECT_LT(rms_m, 0.020);
  EXPECT_GT(rms_m, 0.012);
}

TEST(Gps, forgets_the_last_flight_at_start) {
  const auto gps = make("gps");
  Work work;
  (void)gps->estimate(fix_at(0.0, {50, 0, 0}, {9, 0, 0}), work);
  gps->start(GeodeticOrigin{});
  EXPECT_FALSE(gps->estimate(without_fix(1.0), work));
}

TEST(Gps, grows_old_without_fixes_and_begins_anew_with_the_next_one) {
  const auto gps = make("gps");
  Work work;
  (void)gps->estimate(fix_at(1.0, {10, 0, 5}, {2, 0, 0}), work);
  EXPECT_EQ(gps->estimate(without_fix(1.4), work)->stamp, at(1.4));
  const PoseEstimate old = gps->estimate(without_fix(9.0), work).value();
  EXPECT_EQ(old.stamp, at(1.5));
  EXPECT_LT((old.X_WB.translation() - Vec3{11, 0, 5}).norm(), 0.002);
  const PoseEstimate fresh = gps->estimate(fix_at(9.1, {30, 0, 5}, {2, 0, 0}), work).value();
  EXPECT_EQ(fresh.stamp, at(9.1));
  EXPECT_LT((fresh.X_WB.translation() - Vec3{30, 0, 5}).norm(), 0.002);
}

}  // namespace
}  // namespace flyball
