// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/command_sender.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

MavCommandLong arming() {
  MavCommandLong command;
  command.command = mav::command_arm;
  return command;
}

MavCommandAck answer(std::uint8_t result, std::uint16_t command = mav::command_arm) {
  MavCommandAck ack;
  ack.command = command;
  ack.result = result;
  return ack;
}

TEST(CommandSender, repeats_a_command_with_a_counter_and_then_says_which_one_was_not_answered) {
  CommandSender sender;
  sender.ask(arming(), "to arm", 0s);
  std::vector<int> confirmations;
  Duration now{};
  for (; now < 10s && sender.failure().empty(); now += 10ms) {
    if (const auto command = sender.due(now)) {
      confirmations.push_back(command->confirmation);
    }
  }
  EXPECT_EQ(confirmations, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(sender.failure(), "the autopilot was asked to arm and did not answer, 5 times");
  EXPECT_FALSE(sender.is_waiting());
}

TEST(CommandSender, is_content_with_the_first_answer) {
  CommandSender sender;
  sender.ask(arming(), "to arm", 0s);
  EXPECT_TRUE(sender.due(0s));
  sender.hear(answer(mav::result_accepted), 100ms);
  EXPECT_TRUE(sender.is_accepted());
  sender.hear(answer(2), 200ms);  // A late copy of something.
  EXPECT_TRUE(sender.is_accepted());
  EXPECT_FALSE(sender.due(5s));
}

TEST(CommandSender, does_not_take_the_answer_to_another_command) {
  CommandSender sender;
  sender.ask(arming(), "to arm", 0s);
  EXPECT_TRUE(sender.due(0s));
  sender.hear(answer(mav::result_accepted, mav::command_land), 100ms);
  EXPECT_TRUE(sender.is_waiting());
}

TEST(CommandSender, does_not_take_an_answer_before_it_asked) {
  CommandSender sender;
  sender.ask(arming(), "to arm", 1s);
  sender.hear(answer(mav::result_accepted), 1s);
  EXPECT_TRUE(sender.is_waiting());
}

TEST(CommandSender, says_how_it_was_denied) {
  CommandSender sender;
  sender.ask(arming(), "to arm", 0s);
  EXPECT_TRUE(sender.due(0s));
  sender.hear(answer(2), 100ms);
  EXPECT_EQ(sender.failure(), "the autopilot was asked to arm and answered DENIED");
}

TEST(CommandSender, asks_again_a_second_later_where_it_was_put_off) {
  CommandSender sender;
  sender.ask(arming(), "to arm", 0s);
  Duration now{};
  int asked = 0;
  for (; now < 20s && sender.failure().empty(); now += 10ms) {
    if (sender.due(now)) {
      ++asked;
      sender.hear(answer(mav::result_try_later), now);
    }
  }
  EXPECT_EQ(asked, 5);
  EXPECT_GE(now, 4s);
  EXPECT_NE(sender.failure().find("TEMPORARILY_REJECTED"), std::string::npos);
}

TEST(CommandSender, waits_for_an_autopilot_that_is_at_it) {
  CommandSender sender;
  sender.ask(arming(), "to arm", 0s);
  EXPECT_TRUE(sender.due(0s));
  sender.hear(answer(mav::result_in_progress), 100ms);
  EXPECT_FALSE(sender.due(9s));
  EXPECT_TRUE(sender.is_waiting());
  sender.hear(answer(mav::result_accepted), 9s);
  EXPECT_TRUE(sender.is_accepted());
}

}  // namespace
}  // namespace flyball
