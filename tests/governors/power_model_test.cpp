// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/power_model.h"

#include "flyball/runtime/random.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(RotorPower, is_equation_1_in_steady_flight_before_anything_is_measured) {
  const RotorPower rotors;  // Matrice 100, .5 kg: 251.7 + .197 * 500 = 350.2 W in hover
  EXPECT_NEAR(rotors.power(0.0).value(), 350.2, 0.5);
  EXPECT_NEAR(rotors.power(10.0).value(), 350.2 - 25.95, 0.5);
  EXPECT_NEAR(rotors.slope_w_s_m(4.0), -2.595, 1e-12);
}

TEST(RotorPower, learns_the_curve_of_another_vehicle) {
  RotorPower::Prior wide;
  wide.sigma_quadratic_w_s2_m2 = 3.0;
  wide.sigma_linear_w_s_m = 30.0;
  wide.sigma_hover_w = 1000.0;
  RotorPower rotors{wide};
  RandomStream draw{1, "rotor_power"};
  for (int i = 0; i < 4000; ++i) {
    const double v = draw.uniform(0.0, 10.0);
    rotors.learn(v, Watts{180.0 - 12.0 * v + 1.5 * v * v + 5.0 * draw.normal()});
  }
  for (const double v : {0.0, 4.0, 9.0}) {
    EXPECT_NEAR(rotors.power(v).value(), 180.0 - 12.0 * v + 1.5 * v * v, 1.5);
  }
  EXPECT_NEAR(rotors.slope_w_s_m(4.0), 0.0, 0.5);
}

TEST(RotorPower, ignores_a_sensor_that_is_broken) {
  RotorPower rotors;
  const double before_w = rotors.power(3.0).value();
  rotors.learn(3.0, Watts{std::numeric_limits<double>::quiet_NaN()});
  rotors.learn(std::numeric_limits<double>::infinity(), Watts{300.0});
  rotors.learn(3.0, Watts{0.0});
  rotors.learn(1e300, Watts{300.0});
  rotors.learn(3.0, Watts{1e300});
  EXPECT_EQ(rotors.power(3.0).value(), before_w);
}

TEST(JoulesPerMetre, is_power_over_speed) {
  EXPECT_DOUBLE_EQ(joules_per_metre(Watts{340.0}, Watts{10.0}, 7.0), 50.0);
}

}  // namespace
}  // namespace flyball
