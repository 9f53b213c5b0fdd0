// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/platform.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

PlatformModel model() {
  PlatformModel model;
  model.name = "bench";
  model.max_cores = 4;
  model.frequencies = {Hertz{0.8e9}, Hertz{2.0e9}};
  model.switching_time = std::chrono::microseconds{300};
  KernelCost mapper;
  mapper.seconds_per = {{"rays", 2e-6}, {"updates", 5e-7}};
  mapper.scale = 3.0;
  mapper.a = 0.75;
  mapper.b = 0.25;
  mapper.parallel_fraction = 0.6;
  model.kernels["mapper"] = mapper;
  model.power = {0.6, 1.24, 0.5, 0.2, 0.15, 0.05, 0.11, 0.095};
  return model;
}

Work scan() {
  Work work;
  work.add("rays", 1000.0);
  work.add("updates", 40000.0);
  work.add("prayers", 7.0);  // not on the price list: free of charge
  return work;
}

TEST(ModeledPlatform, prices_work_by_count_and_clock) {
  const ModeledPlatform platform{model()};
  const double at_one_ghz_s = 3.0 * (1000.0 * 2e-6 + 40000.0 * 5e-7);
  for (const double ghz : {0.8, 1.0, 2.0}) {
    EXPECT_NEAR(to_seconds(platform.job_time("mapper", scan(), Hertz{ghz * 1e9})),
                at_one_ghz_s * (0.75 / ghz + 0.25), 2e-9);
  }
}

TEST(ModeledPlatform, charges_nothing_for_an_unknown_kernel_and_says_that_it_is_unknown) {
  const ModeledPlatform platform{model()};
  EXPECT_TRUE(platform.knows("mapper"));
  EXPECT_FALSE(platform.knows("planner"));
  EXPECT_EQ(platform.job_time("planner", scan(), Hertz{1e9}), Duration::zero());
  EXPECT_EQ(platform.speedup("planner", 4.0), 1.0);
}

TEST(ModeledPlatform, speeds_up_by_amdahl) {
  const ModeledPlatform platform{model()};
  EXPECT_EQ(platform.speedup("mapper", 0.3), 1.0);
  EXPECT_EQ(platform.speedup("mapper", 1.0), 1.0);
  EXPECT_NEAR(platform.speedup("mapper", 2.0), 1.0 / 0.7, 1e-12);
  EXPECT_NEAR(platform.speedup("mapper", 1e12), 2.5, 1e-9);
}

TEST(ModeledPlatform, power_is_constant_linear_and_cubic_in_the_clock) {
  const ModeledPlatform platform{model()};
  // the TX2's four cores at 2.035 GHz: 4.3 W of CPU (facts.md)
  const Watts idle = platform.power({4, Hertz{2.035e9}}, 0.0);
  const Watts busy = platform.power({4, Hertz{2.035e9}}, 4.0);
  EXPECT_NEAR(idle.value(), 0.6 + 1.24 * (0.7 + 0.15 + 0.05 * 2.035), 1e-9);
  EXPECT_NEAR((busy - idle).value(), 1.24 * 4.0 * (0.11 * 2.035 + 0.095 * 8.4274), 1e-3);
}

TEST(ModeledPlatform, the_memory_clock_rises_in_steps_with_the_cores) {
  PlatformModel with_steps = model();
  with_steps.power.memory_linear_w = 0.4;
  with_steps.power.memory_clocks = {{Hertz{0.5e9}, Hertz{0.4e9}}, {Hertz{1.4e9}, Hertz{1.9e9}}};
  const ModeledPlatform platform{with_steps};
  const ModeledPlatform without{model()};
  const auto added_w = [&](double hz) {
    return (platform.power({4, Hertz{hz}}, 1.0) - without.power({4, Hertz{hz}}, 1.0)).value();
  };
  EXPECT_NEAR(added_w(0.4e9), 0.0, 1e-12);
  EXPECT_NEAR(added_w(0.5e9), 1.24 * 0.4 * 0.4, 1e-12);
  EXPECT_NEAR(added_w(1.3e9), 1.24 * 0.4 * 0.4, 1e-12);
  EXPECT_NEAR(added_w(2.0e9), 1.24 * 0.4 * 1.9, 1e-12);
}

TEST(ModeledPlatform, a_price_that_no_mission_could_pay_is_the_longest_time) {
  PlatformModel dear = model();
  dear.kernels.find("mapper")->second.seconds_per["rays"] = 1e300;
  const ModeledPlatform platform{dear};
  EXPECT_NEAR(to_seconds(platform.job_time("mapper", scan(), Hertz{1e9})), 1e9, 1e-6);
  dear.kernels.find("mapper")->second.scale = 1e300;
  EXPECT_NEAR(to_seconds(ModeledPlatform{dear}.job_time("mapper", scan(), Hertz{1e9})), 1e9, 1e-6);
}

TEST(ModeledPlatformDeathTest, a_count_that_is_no_number_is_a_broken_kernel) {
  const ModeledPlatform platform{model()};
  Work work;
  work.add("rays", 0.0 / 0.0);
  EXPECT_DEATH((void)platform.job_time("mapper", work, Hertz{1e9}), "of one job");
}

}  // namespace
}  // namespace flyball
