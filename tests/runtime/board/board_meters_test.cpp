// SPDX-License-Identifier: BSD-3-Clause
#include "board/board_meters.h"

#include "fake_trees.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr Duration second = std::chrono::seconds{1};

struct Metered {
  template <class Plant>
  explicit Metered(Plant plant) {
    plant(tree);
  }
  [[nodiscard]] PowerMeter meter() const { return {*system, discover_board(*system), {}}; }
  fake::Tree tree{};
  std::unique_ptr<LinuxSystem> system{linux_system(tree.root())};
};

TEST(PowerMeter, takes_the_input_rail_and_no_sum) {
  for (const auto plant : {fake::plant_tx2_r28, fake::plant_tx2_r32, fake::plant_orin}) {
    const Metered board{plant};
    PowerMeter meter = board.meter();
    EXPECT_EQ(meter.source(), "VDD_IN");
    EXPECT_FALSE(meter.power());
    meter.sample({});
    ASSERT_TRUE(meter.power());
    EXPECT_GT(meter.power()->value(), 3.9);
    EXPECT_LT(meter.power()->value(), 6.1);
  }
}

TEST(PowerByRail, tells_the_parts_that_have_a_rail_of_their_own) {
  const Metered tx2{fake::plant_tx2_r28};
  const RailPower parts = power_by_rail(*tx2.system, discover_board(*tx2.system).rails);
  EXPECT_DOUBLE_EQ(parts.cpu.value(), 0.840);
  EXPECT_DOUBLE_EQ(parts.gpu.value(), 0.152);
  EXPECT_DOUBLE_EQ(parts.memory.value(), 0.611);
  EXPECT_DOUBLE_EQ(parts.soc.value(), 0.534);
  const Metered orin{fake::plant_orin};  // Its rail VDD_CPU_GPU_CV is that of three parts.
  const RailPower shared = power_by_rail(*orin.system, discover_board(*orin.system).rails);
  EXPECT_EQ(shared.cpu.value(), 0.0);
  EXPECT_GT(shared.soc.value(), 1.0);
}

TEST(PowerMeter, averages_over_a_second) {
  const Metered board{fake::plant_tx2_r28};
  const std::string file = "/sys/bus/i2c/drivers/ina3221x/0-0041/iio:device1/in_power0_input";
  PowerMeter meter = board.meter();
  board.tree.put(file, "2000\n");
  meter.sample({});
  board.tree.put(file, "4000\n");
  meter.sample(second / 2);
  EXPECT_DOUBLE_EQ(meter.power()->value(), 3.0);
  meter.sample(second * 5 / 4);
  EXPECT_DOUBLE_EQ(meter.power()->value(), 4.0);
}

TEST(PowerMeter, has_nothing_to_say_a_second_after_the_rail_has_gone) {
  const Metered board{fake::plant_tx2_r28};
  PowerMeter meter = board.meter();
  meter.sample({});
  board.tree.put("/sys/bus/i2c/drivers/ina3221x/0-0041/iio:device1/in_power0_input", "\n");
  meter.sample(second / 2);
  EXPECT_TRUE(meter.power());
  meter.sample(2 * second);
  EXPECT_FALSE(meter.power());
}

TEST(PowerMeter, counts_joules_over_the_end_of_the_range) {
  const Metered board{fake::plant_x86};
  const std::string file = "/sys/class/powercap/intel-rapl:1/energy_uj";
  PowerMeter meter = board.meter();
  EXPECT_EQ(meter.source(), "psys");
  board.tree.put(file, "262143000000\n");
  meter.sample({});
  EXPECT_FALSE(meter.power());
  board.tree.put(file, "7671150\n");  // .32885 J to the end, and 7.67115 J from 0
  meter.sample(second / 2);
  EXPECT_NEAR(meter.power()->value(), 16.0, 1e-9);
}

TEST(PowerMeter, has_no_source_on_a_pi_5) {
  EXPECT_EQ(Metered{fake::plant_pi5}.meter().source(), "");
}

TEST(PowerMeter, says_that_packages_are_not_the_board) {
  const Metered board{fake::plant_x86};
  board.tree.put("/sys/class/powercap/intel-rapl:1/name", "dram\n");
  EXPECT_EQ(board.meter().source(), "package-0 (without the board)");
}

TEST(ClosestHeat, is_the_zone_that_is_nearest_to_its_trip) {
  const Metered board{fake::plant_tx2_r28};
  BoardFile file;
  file.ignored_zones = {"PMIC-Die"};
  const auto heat = closest_heat(*board.system, discover_board(*board.system).zones, file);
  ASSERT_TRUE(heat);
  EXPECT_EQ(heat->zone, "MCPU-therm");
  EXPECT_DOUBLE_EQ(heat->temperature_c, 43.0);
  EXPECT_DOUBLE_EQ(heat->trip_c.value_or(0.0), 95.5);
}

TEST(ClosestHeat, prefers_a_zone_that_takes_clocks_away) {
  const Metered board{fake::plant_x86};
  const auto heat = closest_heat(*board.system, discover_board(*board.system).zones, {});
  ASSERT_TRUE(heat);
  EXPECT_EQ(heat->zone, "acpitz");  // The other one is hotter and has no trip.
}

TEST(PowerMeter, has_nothing_to_say_after_a_counter_has_gone_and_begins_anew_when_it_is_back) {
  const Metered board{fake::plant_x86};
  const std::string file = "/sys/class/powercap/intel-rapl:1/energy_uj";
  PowerMeter meter = board.meter();
  board.tree.put(file, "1000000\n");
  meter.sample({});
  board.tree.put(file, "6000000\n");
  meter.sample(second);
  EXPECT_NEAR(meter.power()->value(), 5.0, 1e-9);
  board.tree.put(file, "\n");
  meter.sample(3 * second);
  EXPECT_FALSE(meter.power());
  board.tree.put(file, "100000000\n");
  meter.sample(4 * second);
  EXPECT_FALSE(meter.power()) << "nobody knows what happened meanwhile";
  board.tree.put(file, "103000000\n");
  meter.sample(5 * second);
  EXPECT_NEAR(meter.power()->value(), 3.0, 1e-9);
}

}  // namespace
}  // namespace flyball
