// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/wind.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double height_m = 15.24;  // 50 ft
constexpr double gust_wind_m_s = 15.4;

/// Gusts along a straight flight through air that stands still, one each `step_m`.
struct Flight {
  explicit Flight(double step_m, int steps, std::uint64_t seed = 1) {
    Wind wind{{Vec3::Zero(), gust_wind_m_s}, seed};
    for (int i = 0; i < steps; ++i) {
      wind.advance(step_m / 10.0, height_m, Vec3{10.0, 0.0, 0.0});
      gusts.push_back(wind.velocity_W());
    }
  }
  /// Mean product of a component with itself `lag` steps on.
  [[nodiscard]] double correlation(int component, int lag) const {
    double sum = 0.0;
    const std::size_t pairs = gusts.size() - static_cast<std::size_t>(lag);
    for (std::size_t i = 0; i < pairs; ++i) {
      sum += gusts[i][component] * gusts[i + static_cast<std::size_t>(lag)][component];
    }
    return sum / static_cast<double>(pairs);
  }
  std::vector<Vec3> gusts;
};

TEST(GustScale, has_the_lengths_and_strengths_of_the_low_altitude_model) {
  const GustScale at_50ft = gust_scale(50.0 * 0.3048, 10.0);
  EXPECT_NEAR(at_50ft.vertical_m, 15.24, 1e-9);
  EXPECT_NEAR(at_50ft.level_m, 15.24 / std::pow(0.177 + 0.04115, 1.2), 1e-9);
  EXPECT_NEAR(at_50ft.vertical_m_s, 1.0, 1e-12);
  EXPECT_NEAR(at_50ft.level_m_s, 1.0 / std::pow(0.21815, 0.4), 1e-9);
  // At 1000 ft the model joins the one of medium altitude, where turbulence is isotropic.
  const GustScale at_1000ft = gust_scale(304.8, 10.0);
  EXPECT_NEAR(at_1000ft.level_m, at_1000ft.vertical_m, 1e-6);
  EXPECT_NEAR(at_1000ft.level_m_s, at_1000ft.vertical_m_s, 1e-9);
  EXPECT_EQ(gust_scale(0.0, 10.0).vertical_m, 3.048);
}

// 40 000 steps of a tenth of L_u are 4000 lengths: the variance's own deviation is sqrt(2/2000) of
// it, 3 %; of the vertical component, whose length is a sixth, less.
TEST(Wind, has_the_variances_of_the_spectra) {
  const GustScale scale = gust_scale(height_m, gust_wind_m_s);
  const Flight flight{0.1 * scale.level_m, 40000};
  const double level = scale.level_m_s * scale.level_m_s;
  EXPECT_NEAR(flight.correlation(0, 0) / level, 1.0, 0.10);
  EXPECT_NEAR(flight.correlation(1, 0) / level, 1.0, 0.10);
  EXPECT_NEAR(flight.correlation(2, 0) / (scale.vertical_m_s * scale.vertical_m_s), 1.0, 0.05);
}

TEST(Wind, forgets_over_the_lengths_of_the_spectra) {
  const GustScale scale = gust_scale(height_m, gust_wind_m_s);
  const Flight level{0.25 * scale.level_m, 60000, 2};
  const Flight upright{0.25 * scale.vertical_m, 60000, 3};
  for (const int lag : {2, 4, 8}) {
    const double r = 0.25 * lag;  // In lengths.
    EXPECT_NEAR(level.correlation(0, lag) / level.correlation(0, 0), std::exp(-r), 0.04) << r;
    const double across = std::exp(-r) * (1.0 - 0.5 * r);
    EXPECT_NEAR(level.correlation(1, lag) / level.correlation(1, 0), across, 0.04) << r;
    EXPECT_NEAR(upright.correlation(2, lag) / upright.correlation(2, 0), across, 0.04) << r;
  }
}

TEST(Wind, has_the_same_spectrum_whatever_the_time_step) {
  const GustScale scale = gust_scale(height_m, gust_wind_m_s);
  const Flight fine{0.05 * scale.vertical_m, 100000, 4};
  const Flight coarse{1.0 * scale.vertical_m, 20000, 5};
  const double length = std::exp(-1.0) * 0.5;  // Transverse, one length on.
  EXPECT_NEAR(fine.correlation(2, 20) / fine.correlation(2, 0), length, 0.04);
  EXPECT_NEAR(coarse.correlation(2, 1) / coarse.correlation(2, 0), length, 0.04);
  EXPECT_NEAR(fine.correlation(2, 0) / coarse.correlation(2, 0), 1.0, 0.08);
}

TEST(Wind, is_steady_without_gusts_and_seeded_with_them) {
  Wind steady{{Vec3{3.0, -1.0, 0.0}, 0.0}, 1};
  steady.advance(0.01, 10.0, Vec3{5.0, 0.0, 0.0});
  EXPECT_EQ(steady.velocity_W(), (Vec3{3.0, -1.0, 0.0}));
  const Flight first{1.0, 50, 7};
  EXPECT_EQ(first.gusts, (Flight{1.0, 50, 7}.gusts));
  EXPECT_NE(first.gusts, (Flight{1.0, 50, 8}.gusts));
}

}  // namespace
}  // namespace flyball
