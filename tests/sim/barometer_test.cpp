// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/barometer.h"

#include "flyball/runtime/atmosphere.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

TEST(Barometer, without_noise_it_tells_the_height) {
  Barometer barometer{{0.0, 0.0, 300.0}, 400.0, 1};
  const double low_pa = barometer.sample(0.0, at(0.0));
  const double high_pa = barometer.sample(12.5, at(0.01));
  EXPECT_NEAR(pressure_height_m(low_pa), 400.0, 1e-6);
  EXPECT_NEAR(pressure_height_m(high_pa), 412.5, 1e-6);
}

TEST(Barometer, noise_has_the_deviation_of_its_data_sheet) {
  Barometer barometer{{1.2, 0.0, 300.0}, 0.0, 2};
  constexpr int samples = 20000;
  double squares = 0.0;
  for (int i = 0; i < samples; ++i) {
    squares += std::pow(barometer.sample(0.0, at(0.01 * i)) - standard_pressure_pa(0.0), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / samples), 1.2, 0.03);  // Its own deviation: .006.
}

TEST(Barometer, bias_wanders_but_not_between_two_samples) {
  double start_squares = 0.0;
  double step_squares = 0.0;
  constexpr int vehicles = 2000;
  for (int seed = 0; seed < vehicles; ++seed) {
    Barometer barometer{{0.0, 12.0, 300.0}, 0.0, static_cast<std::uint64_t>(seed)};
    const double first_pa = barometer.sample(0.0, at(0.0));
    const double next_pa = barometer.sample(0.0, at(3.0));
    start_squares += std::pow(first_pa - standard_pressure_pa(0.0), 2);
    step_squares += std::pow(next_pa - first_pa, 2);
  }
  EXPECT_NEAR(std::sqrt(start_squares / vehicles), 12.0, 0.8);
  // After 1 % of the correlation time: 12 sqrt(2 (1 - exp(-.01))) = 1.69.
  EXPECT_NEAR(std::sqrt(step_squares / vehicles), 1.69, 0.12);
}

TEST(Barometer, same_seed_same_pressures) {
  Barometer one{{}, 0.0, 5};
  Barometer other{{}, 0.0, 5};
  Barometer another{{}, 0.0, 6};
  const double first_pa = one.sample(1.0, at(0.0));
  EXPECT_EQ(first_pa, other.sample(1.0, at(0.0)));
  EXPECT_NE(first_pa, another.sample(1.0, at(0.0)));
}

}  // namespace
}  // namespace flyball
