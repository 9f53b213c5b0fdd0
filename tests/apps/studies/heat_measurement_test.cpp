// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/heat_measurement.h"

#include "flyball/runtime/random.h"
#include "flyball/runtime/realtime/cpus.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A board of one heat capacity, 15 W busy and 5 W idle, each for three minutes, as a sensor of
/// half degrees and a meter with 2 % of noise tell it.
std::vector<HeatSample> watched(const ThermalModel& truth) {
  ThermalState board{truth, Watts{5.0}};
  RandomStream noise{1, "meter"};
  std::vector<HeatSample> samples;
  for (int t_s = 1; t_s <= 360; ++t_s) {
    const double power_w = t_s <= 180 ? 15.0 : 5.0;
    board.step(Watts{power_w}, 1.0);
    samples.push_back({static_cast<double>(t_s), Watts{power_w * noise.uniform(0.98, 1.02)},
                       0.5 * std::round(2.0 * board.temperature_c())});
  }
  return samples;
}

TEST(FittedHeat, finds_air_resistance_and_time_constant) {
  for (const ThermalModel& truth :
       {ThermalModel{25.0, 2.0, 60.0, {}}, ThermalModel{35.0, 1.0, 20.0, {}},
        ThermalModel{10.0, 4.0, 150.0, {}}}) {
    const auto fit = fitted_heat(watched(truth));
    ASSERT_TRUE(fit) << fit.error().message;
    EXPECT_NEAR(fit->model.ambient_c, truth.ambient_c, 1.5);
    EXPECT_NEAR(fit->model.resistance_k_w / truth.resistance_k_w, 1.0, 0.05);
    EXPECT_NEAR(fit->model.time_constant_s / truth.time_constant_s, 1.0, 0.1);
    EXPECT_LT(fit->worst_k, 0.6);
  }
}

TEST(FittedHeat, says_when_a_board_stays_cool) {
  const auto fit = fitted_heat(watched({25.0, 0.2, 60.0, {}}));
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().message, "heat was watched, but the temperature changed by less than 3 K");
  EXPECT_FALSE(fitted_heat({}));
}

TEST(FittedHeat, says_when_something_else_makes_it_warm) {
  std::vector<HeatSample> samples = watched({25.0, 2.0, 60.0, {}});
  for (HeatSample& sample : samples) {
    sample.temperature_c = 20.0 + 0.1 * sample.t_s;  // The sun, say.
  }
  EXPECT_FALSE(fitted_heat(samples));
  for (HeatSample& sample : samples) {
    sample.temperature_c = 40.0 - sample.power.value();  // A fan that blows harder when it works.
  }
  EXPECT_FALSE(fitted_heat(samples));
}

HeatMeasurement quick() {
  HeatMeasurement how;
  how.cpus = {usable_cpus().front()};
  how.phase = 5ms;
  how.period = 1ms;
  return how;
}

TEST(HeatMeasurement, watches_busy_and_idle_alike) {
  HeatMeasurement how = quick();
  double t_s = 0.0;
  how.meter = [&t_s] { return HeatSample{t_s += 1.0, Watts{5.0}, 40.0}; };
  const auto samples = measure_heat(how);
  ASSERT_TRUE(samples);
  ASSERT_EQ(samples->size(), 10U);
  EXPECT_EQ(samples->back().t_s, 10.0);
}

TEST(HeatMeasurement, stops_when_asked_and_says_which_core_it_cannot_use) {
  HeatMeasurement how = quick();
  how.meter = [] { return HeatSample{}; };
  how.stop = [] { return true; };
  EXPECT_FALSE(measure_heat(how));
  how.stop = nullptr;
  how.cpus = {1000000};
  const auto refused = measure_heat(how);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("1000000"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace flyball
