// SPDX-License-Identifier: BSD-3-Clause
#include "board/clock_control.h"

#include "fake_kernel.h"
#include "fake_trees.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Lines = std::vector<std::string>;

class ClockControlTest : public testing::Test {
 protected:
  template <class Planting>
  ClockControl& plant(Planting put) {
    put(tree_);
    auto opened = SettingsKeeper::open(kernel_, {tree_.root() + "/run", false});
    EXPECT_TRUE(opened.ok());
    keeper_ = std::move(*opened);
    const CpufreqPolicy policy = discover_board(kernel_).policies.front();
    control_.emplace(kernel_, *keeper_, policy, clocks_of(policy, {}));
    return *control_;
  }

  fake::Tree tree_{};
  fake::Kernel kernel_{tree_.root()};
  std::unique_ptr<SettingsKeeper> keeper_{};
  std::optional<ClockControl> control_{};
};

TEST(FakeKernel, refuses_limits_in_the_wrong_order_as_the_kernel_does) {
  const fake::Tree tree;
  fake::plant_pi5(tree);
  fake::Kernel kernel{tree.root()};
  const std::string folder = "/sys/devices/system/cpu/cpufreq/policy0/";
  ASSERT_TRUE(kernel.write(folder + "scaling_max_freq", "1600000").ok());
  const Status wrong = kernel.write(folder + "scaling_min_freq", "2000000");
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().code, ErrorCode::invalid_input);
  EXPECT_EQ(kernel.write(folder + "scaling_setspeed", "1600000").error().code,
            ErrorCode::invalid_input);  // not without userspace
}

TEST_F(ClockControlTest, writes_the_governor_then_the_clock) {
  ClockControl& control = plant(fake::plant_tx2_r32);
  ASSERT_TRUE(control.set(Hertz{1420.8e6}).ok());
  EXPECT_EQ(kernel_.writes,
            (Lines{"policy0/scaling_governor=userspace", "policy0/scaling_setspeed=1420800"}));
  EXPECT_EQ(control.reported(), Hertz{1420.8e6});
  ASSERT_TRUE(control.set(Hertz{2035.2e6}).ok());
  EXPECT_EQ(kernel_.writes.size(), 3U);  // one write for each further clock
}

TEST_F(ClockControlTest, writes_to_the_first_of_the_folders_of_r28) {
  ClockControl& control = plant(fake::plant_tx2_r28);
  ASSERT_TRUE(control.set(Hertz{499.2e6}).ok());
  EXPECT_EQ(kernel_.writes, (Lines{"cpu0/cpufreq/scaling_governor=userspace",
                                   "cpu0/cpufreq/scaling_setspeed=499200"}));
}

TEST_F(ClockControlTest, lowers_the_lower_limit_before_the_upper_one) {
  ClockControl& control = plant(fake::plant_x86);
  ASSERT_TRUE(control.set(Hertz{2000e6}).ok());
  ASSERT_TRUE(control.set(Hertz{1000e6}).ok());
  ASSERT_TRUE(control.set(Hertz{3000e6}).ok());
  EXPECT_EQ(kernel_.writes,
            (Lines{"policy0/scaling_min_freq=2000000", "policy0/scaling_max_freq=2000000",
                   "policy0/scaling_min_freq=1000000", "policy0/scaling_max_freq=1000000",
                   "policy0/scaling_max_freq=3000000", "policy0/scaling_min_freq=3000000"}));
}

TEST_F(ClockControlTest, is_never_refused_on_the_way_from_any_clock_to_any_other) {
  ClockControl& control = plant(fake::plant_x86);
  const std::vector<Hertz>& clocks = control.clocks();
  for (const Hertz from : clocks) {
    for (const Hertz to : {clocks.front(), clocks[clocks.size() / 2], clocks.back()}) {
      ASSERT_TRUE(control.set(from).ok());
      ASSERT_TRUE(control.set(to).ok());
      ASSERT_EQ(control.reported(), to);
    }
  }
}

TEST_F(ClockControlTest, takes_the_next_lower_clock_that_there_is) {
  ClockControl& control = plant(fake::plant_tx2_r32);
  ASSERT_TRUE(control.set(Hertz{1500e6}).ok());
  EXPECT_EQ(control.requested(), Hertz{1420.8e6});
  ASSERT_TRUE(control.set(Hertz{1.0}).ok());
  EXPECT_EQ(control.requested(), Hertz{345.6e6});
}

TEST_F(ClockControlTest, moves_limits_of_others_out_of_the_way) {
  ClockControl& control = plant(fake::plant_tx2_r32);
  const std::string folder = "/sys/devices/system/cpu/cpufreq/policy0/";
  ASSERT_TRUE(control.set(Hertz{1420.8e6}).ok());
  EXPECT_TRUE(control.is_as_set());
  tree_.put(folder + "scaling_max_freq", "1113600\n");
  EXPECT_FALSE(control.is_as_set());
  ASSERT_TRUE(control.set(Hertz{1420.8e6}).ok());
  EXPECT_TRUE(control.is_as_set());
  EXPECT_EQ(tree_.get(folder + "scaling_max_freq"), "1420800\n");
  tree_.put(folder + "scaling_governor", "schedutil\n");
  EXPECT_FALSE(control.is_as_set());
}

TEST_F(ClockControlTest, leaves_a_limit_that_heat_has_lowered_to_the_kernel) {
  kernel_.cooled_khz = 1800000;
  ClockControl& control = plant(fake::plant_pi5);
  ASSERT_TRUE(control.set(Hertz{1600e6}).ok());
  kernel_.cooled_khz = 0;
  EXPECT_TRUE(keeper_->restore().empty());
  EXPECT_EQ(tree_.get("/sys/devices/system/cpu/cpufreq/policy0/scaling_max_freq"), "2400000\n");
}

TEST_F(ClockControlTest, uses_the_limits_where_userspace_is_listed_but_refused) {
  ClockControl& control = plant(fake::plant_pi5);
  kernel_.refused["scaling_governor"] = EINVAL;
  ASSERT_TRUE(control.set(Hertz{1800e6}).ok());
  EXPECT_EQ(tree_.get("/sys/devices/system/cpu/cpufreq/policy0/scaling_max_freq"), "1800000\n");
  EXPECT_EQ(tree_.get("/sys/devices/system/cpu/cpufreq/policy0/scaling_min_freq"), "1800000\n");
}

TEST_F(ClockControlTest, says_what_the_files_hold_instead) {
  ClockControl& control = plant(fake::plant_pi5);
  kernel_.lies["scaling_setspeed"] = "1500000\n";
  const Status set = control.set(Hertz{1800e6});
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.error().message,
            "/sys/devices/system/cpu/cpufreq/policy0/scaling_setspeed was given 1800 MHz and holds "
            "1500 MHz");
}

TEST_F(ClockControlTest, names_the_file_that_is_read_only) {
  ClockControl& control = plant(fake::plant_pi5);
  kernel_.refused["scaling_governor"] = EROFS;
  const Status set = control.set(Hertz{1800e6});
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.error().code, ErrorCode::unavailable);
  EXPECT_EQ(set.error().message,
            "\"userspace\" cannot be written to /sys/devices/system/cpu/cpufreq/policy0/"
            "scaling_governor: Read-only file system");
}

TEST(ClocksOf, are_steps_where_the_driver_lists_none) {
  CpufreqPolicy policy;
  policy.lowest = Hertz{400e6};
  policy.max = Hertz{1250e6};
  const std::vector<Hertz> clocks = clocks_of(policy, {});
  ASSERT_EQ(clocks.size(), 10U);
  EXPECT_EQ(clocks.front(), Hertz{400e6});
  EXPECT_EQ(clocks[8], Hertz{1200e6});
  EXPECT_EQ(clocks.back(), Hertz{1250e6});
}

TEST(ClocksOf, end_at_the_power_mode_and_begin_where_the_firmware_listens) {
  CpufreqPolicy policy;
  policy.frequencies = {Hertz{1e9}, Hertz{1.5e9}, Hertz{2e9}, Hertz{2.4e9}};
  policy.lowest = Hertz{1e9};
  policy.max = Hertz{2e9};
  BoardFile board;
  board.lowest_kept_clock = Hertz{1.5e9};
  EXPECT_EQ(clocks_of(policy, board), (std::vector<Hertz>{Hertz{1.5e9}, Hertz{2e9}}));
  policy.max = Hertz{1.2e9};  // A mode below all that is kept: its own limit is left.
  EXPECT_EQ(clocks_of(policy, board), (std::vector<Hertz>{Hertz{1.2e9}}));
}

}  // namespace
}  // namespace flyball
