// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(BoardModel, draws_what_the_platform_draws_that_it_comes_from) {
  PlatformModel platform;
  platform.max_cores = 6;
  platform.frequencies = {Hertz{0.5e9}, Hertz{1.9e9}};
  platform.switching_time = std::chrono::microseconds{40};
  platform.power.board_w = 1.5;
  platform.power.core_cubic_w = 0.3;
  platform.thermal = ThermalModel{30.0, 4.0, 100.0, {{70.0, 2.0, Hertz{0.5e9}}}};
  const BoardModel board = board_model_of(platform);
  EXPECT_EQ(board.max_cores, 6);
  EXPECT_EQ(board.frequencies, platform.frequencies);
  EXPECT_EQ(board.switching_time, platform.switching_time);
  ASSERT_TRUE(board.power);
  const ModeledPlatform flown{platform};
  for (const Hertz clock : platform.frequencies) {
    EXPECT_EQ(board.power->power(clock, 2.5).value(), flown.power({6, clock}, 2.5).value());
  }
  ASSERT_TRUE(board.thermal);
  EXPECT_EQ(board.thermal->trips.front().at_c, 70.0);
}

TEST(BoardModel, of_a_platform_that_never_gets_too_hot_has_no_heat) {
  EXPECT_FALSE(board_model_of({}).thermal);
}

TEST(BoardModel, knows_which_clocks_of_others_it_lacks) {
  BoardModel board;
  const std::vector<Hertz> wanted{Hertz{0.6e9}, Hertz{1.02e9}, Hertz{2.0e9}};
  EXPECT_TRUE(clocks_missing_on(board, wanted).empty()) << "nothing is known";
  board.frequencies = {Hertz{0.6e9}, Hertz{1.0e9}, Hertz{1.5e9}};
  EXPECT_EQ(clocks_missing_on(board, wanted), (std::vector<Hertz>{Hertz{2.0e9}}));
}

}  // namespace
}  // namespace flyball
