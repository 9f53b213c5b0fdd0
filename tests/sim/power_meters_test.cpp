// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/power_meters.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double step_s = 0.01;

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  return std::sqrt(squares / static_cast<double>(values.size()));
}

void draw_for(PowerMonitor& meter, double power_w, double duration_s) {
  for (int i = 0; i < std::lround(duration_s / step_s); ++i) {
    meter.add(Watts{power_w}, step_s);
  }
}

TEST(PowerMonitor, counts_in_steps_and_averages_over_a_second) {
  PowerMonitor meter;
  EXPECT_EQ(meter.power().value(), 0.0);
  draw_for(meter, 5.0, 0.09);
  EXPECT_EQ(meter.power().value(), 0.0);
  draw_for(meter, 5.0, 0.01);
  EXPECT_DOUBLE_EQ(meter.power().value(), 66.0 * PowerMonitor::step_w);
  draw_for(meter, 5.0, 0.9);
  draw_for(meter, 10.0, 0.5);
  EXPECT_NEAR(meter.power().value(), 7.5, PowerMonitor::step_w);
  draw_for(meter, 10.0, 0.5);
  EXPECT_NEAR(meter.power().value(), 10.0, 0.5 * PowerMonitor::step_w);
}

TEST(PowerModule, shows_the_start_until_the_first_message) {
  PowerModule module{74.6, 1};
  for (int i = 0; i < 99; ++i) {
    module.add(Watts{300.0}, 74.2, step_s);
    ASSERT_EQ(module.rotor_power().value(), 0.0);
    ASSERT_EQ(module.battery_percent(), 75.0);
  }
  module.add(Watts{300.0}, 74.2, step_s);
  EXPECT_NEAR(module.rotor_power().value(), 300.0, 30.0);
  EXPECT_EQ(module.battery_percent(), 74.0);
}

TEST(PowerModule, errs_by_its_gain_once_and_by_its_noise_each_time) {
  std::vector<double> gains;
  std::vector<double> noises;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    PowerModule module{100.0, seed};
    std::vector<double> shown;
    for (int i = 0; i < 400; ++i) {
      module.add(Watts{200.0}, 100.0, PowerModule::message_s);
      shown.push_back(module.rotor_power().value() / 200.0);
    }
    gains.push_back(mean_of(shown));
    noises.push_back(deviation_of(shown) / gains.back());
  }
  EXPECT_NEAR(mean_of(gains), 1.0, 0.003);
  EXPECT_NEAR(deviation_of(gains), PowerModule::gain_sigma, 0.002);
  EXPECT_NEAR(mean_of(noises), PowerModule::noise_sigma, 0.001);
}

TEST(ThermalZone, counts_in_half_degrees) {
  EXPECT_EQ(thermal_zone_c(41.24), 41.0);
  EXPECT_EQ(thermal_zone_c(41.26), 41.5);
  EXPECT_EQ(thermal_zone_c(-0.3), -0.5);
}

}  // namespace
}  // namespace flyball
