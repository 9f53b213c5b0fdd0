// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/required_power.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(RequiredPower, that_the_board_tells_is_handed_on) {
  BoardModel board;
  board.power.emplace().board_w = 3.0;
  const auto power = required_power("policy \"mine\"", board);
  ASSERT_TRUE(power.ok());
  EXPECT_EQ(power->board_w, 3.0);
}

TEST(RequiredPower, that_nobody_tells_is_asked_for_with_what_to_pass) {
  const auto refused = required_power("policy \"mine\"", {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message.find("policy \"mine\": needs the computer's power"), 0U);
  EXPECT_NE(refused.error().message.find("flyball::BoardModel"), std::string::npos);
}

TEST(RequiredPower, that_no_computer_has_is_refused) {
  for (const double one : {-1.0, 1.7e308, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    BoardModel board;
    board.power.emplace().core_cubic_w = one;
    EXPECT_FALSE(required_power("policy \"mine\"", board).ok()) << one;
  }
}

}  // namespace
}  // namespace flyball
