// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/board_inventory.h"

#include "fake_trees.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

template <class Plant>
BoardInventory discovered(const fake::Tree& tree, Plant plant) {
  plant(tree);
  return discover_board(*linux_system(tree.root()));
}

std::vector<std::string> labels(const BoardInventory& board) {
  std::vector<std::string> names;
  for (const PowerRail& rail : board.rails) {
    names.push_back(rail.label);
  }
  return names;
}

double watts(const fake::Tree& tree, const PowerRail& rail) {
  return rail_power(*linux_system(tree.root()), rail).value_or(Watts{-1.0}).value();
}

using Names = std::vector<std::string>;
using Numbers = std::vector<int>;

TEST(BoardInventory, finds_a_tx2_with_r28) {
  const fake::Tree tree;
  const BoardInventory board = discovered(tree, fake::plant_tx2_r28);
  EXPECT_EQ(board.model, "quill");
  EXPECT_EQ(board.kernel, "4.4.38-tegra");
  // Four folders are one clock.
  ASSERT_EQ(board.policies.size(), 1U);
  EXPECT_EQ(board.policies[0].folder, "/sys/devices/system/cpu/cpu0/cpufreq");
  EXPECT_EQ(board.policies[0].cpus, (Numbers{0, 3, 4, 5}));
  EXPECT_EQ(board.policies[0].frequencies.size(), 12U);
  EXPECT_EQ(board.policies[0].frequencies.front(), Hertz{345.6e6});
  EXPECT_EQ(board.policies[0].governor, "schedutil");
  EXPECT_TRUE(board.policies[0].has_set_speed());
  EXPECT_EQ(labels(board),
            (Names{"VDD_SYS_GPU", "VDD_SYS_SOC", "VDD_IN", "VDD_SYS_CPU", "VDD_SYS_DDR"}));
  EXPECT_DOUBLE_EQ(watts(tree, board.rails[2]), 3.952);
}

TEST(BoardInventory, takes_cores_that_are_off_line_as_a_state) {
  const fake::Tree tree;
  const BoardInventory board = discovered(tree, fake::plant_tx2_r28);
  ASSERT_EQ(board.cores.size(), 6U);
  EXPECT_TRUE(board.cores[0].is_online);
  EXPECT_FALSE(board.cores[0].has_switch);
  EXPECT_FALSE(board.cores[1].is_online);
  EXPECT_TRUE(board.cores[1].has_switch);
  EXPECT_TRUE(board.cores[5].is_online);
}

TEST(BoardInventory, leaves_out_zones_that_are_disconnected_and_reads_trips) {
  const fake::Tree tree;
  const BoardInventory board = discovered(tree, fake::plant_tx2_r28);
  ASSERT_EQ(board.zones.size(), 4U);
  EXPECT_EQ(board.zones[0].type, "BCPU-therm");
  EXPECT_DOUBLE_EQ(board.zones[0].temperature_c.value_or(0.0), 42.5);
  EXPECT_DOUBLE_EQ(board.zones[0].trip_c.value_or(0.0), 95.5);  // not the critical one
  EXPECT_FALSE(board.zones[2].temperature_c);
  EXPECT_FALSE(board.zones[2].trip_c);
}

TEST(BoardInventory, finds_a_tx2_with_r32) {
  const fake::Tree tree;
  const BoardInventory board = discovered(tree, fake::plant_tx2_r32);
  EXPECT_EQ(board.model, "NVIDIA Jetson TX2 Developer Kit");
  ASSERT_EQ(board.policies.size(), 1U);
  EXPECT_EQ(board.policies[0].folder, "/sys/devices/system/cpu/cpufreq/policy0");
  EXPECT_EQ(labels(board), (Names{"VDD_IN", "VDD_SYS_CPU"}));  // neither NC nor the sum
  EXPECT_NEAR(watts(tree, board.rails[0]), 19.008 * 0.208, 1e-9);
}

TEST(BoardInventory, finds_an_orin_with_two_clusters) {
  const fake::Tree tree;
  const BoardInventory board = discovered(tree, fake::plant_orin);
  ASSERT_EQ(board.policies.size(), 2U);
  EXPECT_EQ(board.policies[1].cpus, (Numbers{4, 5, 6, 7}));
  EXPECT_EQ(labels(board), (Names{"VDD_IN", "VDD_CPU_GPU_CV", "VDD_SOC"}));
  EXPECT_FALSE(board.zones[1].temperature_c);  // -256 degrees, in thousandths
  ASSERT_EQ(board.rivals.size(), 1U);
  EXPECT_EQ(board.rivals[0].name, "nvpmodel");
}

TEST(BoardInventory, finds_a_pi_5_without_power_rails) {
  const fake::Tree tree;
  const BoardInventory board = discovered(tree, fake::plant_pi5);
  ASSERT_EQ(board.policies.size(), 1U);
  EXPECT_EQ(board.policies[0].lowest, Hertz{1500e6});
  EXPECT_TRUE(board.rails.empty());
  EXPECT_TRUE(board.counters.empty());
}

TEST(BoardInventory, finds_a_power_monitor_on_the_supply_of_a_pi_5) {
  const fake::Tree tree;
  tree.put("/sys/class/hwmon/hwmon2/name", "ina226\n");
  tree.put("/sys/class/hwmon/hwmon2/power1_input", "6125000\n");
  const BoardInventory board = discovered(tree, fake::plant_pi5);
  EXPECT_EQ(labels(board), (Names{"ina226"}));
  EXPECT_DOUBLE_EQ(watts(tree, board.rails[0]), 6.125);
}

TEST(BoardInventory, finds_a_pc_with_intel_pstate_and_who_fights_over_it) {
  const fake::Tree tree;
  const BoardInventory board = discovered(tree, fake::plant_x86);
  EXPECT_EQ(board.model, "NUC11TNKi5");
  ASSERT_EQ(board.policies.size(), 4U);
  EXPECT_TRUE(board.policies[0].frequencies.empty());
  EXPECT_FALSE(board.policies[0].has_set_speed());
  ASSERT_EQ(board.counters.size(), 2U);  // the cores are a part of their package
  EXPECT_EQ(board.counters[0].name, "package-0");
  EXPECT_EQ(board.counters[1].name, "psys");
  EXPECT_TRUE(board.counters[0].is_readable);
  ASSERT_EQ(board.rivals.size(), 2U);
  EXPECT_EQ(board.rivals[0].name, "power-profiles-daemon");
  EXPECT_EQ(board.rivals[0].pid, 640);
  EXPECT_EQ(board.rivals[1].name, "thermald");
}

TEST(BoardInventory, finds_nothing_in_an_empty_folder) {
  const fake::Tree tree;
  const BoardInventory board = discover_board(*linux_system(tree.root()));
  EXPECT_TRUE(board.policies.empty());
  EXPECT_TRUE(board.cores.empty());
  EXPECT_TRUE(board.rivals.empty());
}

TEST(BoardInventory, leaves_out_files_that_hold_no_numbers) {
  const fake::Tree tree;
  fake::plant_pi5(tree);
  tree.put("/sys/devices/system/cpu/cpufreq/policy0/scaling_max_freq", "fast\n");
  tree.put("/sys/devices/system/cpu/present", "0-x\n");
  tree.put("/sys/class/thermal/thermal_zone0/temp", "\n");
  const BoardInventory board = discover_board(*linux_system(tree.root()));
  EXPECT_TRUE(board.policies.empty());
  EXPECT_EQ(board.cores.size(), 4U);  // by their folders
  EXPECT_FALSE(board.zones[0].temperature_c);
}

}  // namespace
}  // namespace flyball
