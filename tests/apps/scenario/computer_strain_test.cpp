// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/computer_strain.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

ComputerEvent slowdown(double at_s, double until_s, double factor, const char* kernels = "all") {
  ComputerEvent event;
  event.kind = "slowdown";
  event.at_s = at_s;
  event.until_s = until_s;
  event.factor = factor;
  event.kernels = kernels;
  return event;
}

ComputerEvent co_runner(double at_s, double until_s, double cores, double share) {
  ComputerEvent event;
  event.kind = "co_runner";
  event.at_s = at_s;
  event.until_s = until_s;
  event.cores = cores;
  event.memory_share = share;
  return event;
}

MissionTime after(double s) {
  return MissionTime{from_seconds(s)};
}

TEST(ComputerStrain, holds_from_its_beginning_to_just_before_its_end) {
  const std::vector<ComputerEvent> events{slowdown(1.0 / 3.0, 2.0 / 3.0, 3.0)};
  EXPECT_EQ(strain_at(events, after(1.0 / 3.0) - Duration{1}).cost, 1.0);
  EXPECT_EQ(strain_at(events, after(1.0 / 3.0)).cost, 3.0);
  EXPECT_EQ(strain_at(events, after(2.0 / 3.0) - Duration{1}).cost, 3.0);
  EXPECT_EQ(strain_at(events, after(2.0 / 3.0)).cost, 1.0);
}

TEST(ComputerStrain, without_an_end_it_lasts) {
  EXPECT_EQ(strain_at({slowdown(5.0, 0.0, 2.0)}, after(1e5)).cost, 2.0);
}

TEST(ComputerStrain, slowdowns_multiply_and_co_runners_add_up) {
  const Strain strain = strain_at(
      {slowdown(0.0, 0.0, 3.0), slowdown(0.0, 0.0, 2.0),
       slowdown(0.0, 0.0, 5.0, " octomap,rrt_connect "), slowdown(0.0, 0.0, 2.0, "octomap"),
       co_runner(0.0, 0.0, 1.0, 0.5), co_runner(0.0, 0.0, 1.5, 0.2)},
      after(1.0));
  EXPECT_DOUBLE_EQ(strain.cost, 6.0);
  EXPECT_DOUBLE_EQ(strain.kernel_cost.at("octomap"), 10.0);
  EXPECT_DOUBLE_EQ(strain.kernel_cost.at("rrt_connect"), 5.0);
  EXPECT_DOUBLE_EQ(strain.taken_cores, 2.5);
  EXPECT_DOUBLE_EQ(strain.memory_cost, 2.5);
}

TEST(ComputerStrain, co_runners_one_after_the_other_may_take_what_both_may_not) {
  PlatformModel four;
  four.max_cores = 4;
  EXPECT_TRUE(
      impossible_events({co_runner(0.0, 5.0, 3.0, 0.0), co_runner(5.0, 9.0, 3.0, 0.0)}, four)
          .empty());
  EXPECT_EQ(impossible_events({co_runner(0.0, 5.1, 3.0, 0.0), co_runner(5.0, 9.0, 3.0, 0.0)}, four)
                .size(),
            1U);
}

TEST(ComputerStrain, says_what_happens) {
  EXPECT_EQ(describe(slowdown(0.0, 0.0, 3.0), true), "slowdown: 3 times the costs of all kernels");
  EXPECT_EQ(describe(slowdown(0.0, 0.0, 3.0), false), "slowdown ends");
}

}  // namespace
}  // namespace flyball
