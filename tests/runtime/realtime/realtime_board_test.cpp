// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/realtime_board.h"

#include "../board/fake_kernel.h"
#include "../board/fake_trees.h"
#include "realtime_rig.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

class RealtimeBoardTest : public testing::Test {
 protected:
  RealtimeBoardTest() {
    fake::plant_tx2_r32(tree_);
    options_.file.core_order = {0, 3, 4, 5};
    options_.file.ignored_zones = {"PMIC-Die"};
    options_.keeper.run_folder = tree_.root() + "/run";
    options_.measure_clock = [this] { return measured_; };
    auto opened = LinuxBoard::open(kernel_, options_);
    EXPECT_TRUE(opened.ok()) << opened.error().message;
    board_ = std::move(*opened);
    computer_ = std::make_unique<RealtimeBoard>(*board_);
    rig_.settings.grant = [this](const OperatingPoint& wanted) { return computer_->grant(wanted); };
  }

  fake::Tree tree_{};
  fake::Kernel kernel_{tree_.root()};
  LinuxBoardOptions options_{};
  std::optional<Hertz> measured_{};
  std::unique_ptr<LinuxBoard> board_{};
  std::unique_ptr<RealtimeBoard> computer_{};
  RealtimeRig rig_{};
};

TEST_F(RealtimeBoardTest, a_request_of_a_job_sets_the_boards_clock) {
  const auto govern = rig_.add("govern", 0, [&](JobContext&) {
    computer_->request({1, Hertz{1574.4e6}});
  });
  rig_.start();
  computer_->connect(*rig_.executor);
  rig_.executor->publish(govern, 1);
  ASSERT_TRUE(rig_.serve([&] { return rig_.records.size() == 1; }));
  EXPECT_DOUBLE_EQ(computer_->read().granted.frequency.value(), 1574.4e6);
  EXPECT_DOUBLE_EQ(rig_.executor->operating_point().frequency.value(), 1574.4e6);
  EXPECT_NE(
      std::find(kernel_.writes.begin(), kernel_.writes.end(), "policy0/scaling_setspeed=1574400"),
      kernel_.writes.end());
}

TEST_F(RealtimeBoardTest, a_clock_that_the_board_takes_away_reaches_the_executor) {
  rig_.start();
  computer_->connect(*rig_.executor);
  computer_->request({1, Hertz{1574.4e6}});
  const std::size_t writes = kernel_.writes.size();
  measured_ = Hertz{1113.6e6};  // It throttles, and the driver does not say so.
  computer_->refresh(1s);
  EXPECT_DOUBLE_EQ(computer_->read().granted.frequency.value(), 1113.6e6);
  EXPECT_DOUBLE_EQ(rig_.executor->operating_point().frequency.value(), 1113.6e6);
  EXPECT_EQ(kernel_.writes.size(), writes);
  for (const std::string& note : computer_->take_notes()) {
    EXPECT_FALSE(note.empty());
  }
  EXPECT_TRUE(computer_->take_notes().empty());
}

TEST_F(RealtimeBoardTest, a_reading_joins_board_executor_and_vehicle) {
  NodeSpec spec;
  spec.deadline = 1ms;
  const auto late = rig_.add(
      "late", 0,
      [&](JobContext&) {
        EXPECT_TRUE(comes_true([&] { return computer_->read().deadline_misses == 1; }));
      },
      spec);
  rig_.start();
  computer_->connect(*rig_.executor);
  computer_->set_vehicle(Watts{312.0}, 71.0);
  computer_->refresh(1s);
  rig_.executor->publish(late, 1);
  ASSERT_TRUE(rig_.serve([&] { return rig_.records.size() == 1; }));
  const BoardReading reading = computer_->read();
  EXPECT_NEAR(reading.computer_power.value(), 19.008 * 0.208, 1e-9);
  EXPECT_DOUBLE_EQ(reading.temperature_c, 43.0);
  EXPECT_DOUBLE_EQ(reading.trip_c, 95.5);
  EXPECT_DOUBLE_EQ(reading.rotor_power.value(), 312.0);
  EXPECT_DOUBLE_EQ(reading.battery_percent, 71.0);
  EXPECT_EQ(reading.deadline_misses, 1U);
  EXPECT_GT(reading.busy_core_s, 0.0);
}

TEST_F(RealtimeBoardTest, asks_nothing_of_the_board_before_it_is_connected) {
  computer_->request({1, Hertz{1574.4e6}});
  EXPECT_TRUE(kernel_.writes.empty());
}

}  // namespace
}  // namespace flyball
