// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/event_queue.h"

#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at(int ms) {
  return MissionTime{std::chrono::milliseconds{ms}};
}

TEST(EventQueue, runs_events_by_time_then_order_then_age) {
  EventQueue queue;
  std::string seen;
  const auto note = [&seen](char c) { return [&seen, c] { seen += c; }; };
  queue.schedule(at(2), EventOrder::physics, note('f'));
  queue.schedule(at(1), EventOrder::observer, note('e'));
  queue.schedule(at(1), EventOrder::trigger, note('d'));
  queue.schedule(at(1), EventOrder::sensor, note('b'));
  queue.schedule(at(1), EventOrder::sensor, note('c'));
  queue.schedule(at(1), EventOrder::physics, note('a'));
  queue.run([] { return false; });
  EXPECT_EQ(seen, "abcdef");
  EXPECT_EQ(queue.now(), at(2));
}

TEST(EventQueue, an_event_may_schedule_another_at_its_own_time) {
  EventQueue queue;
  std::string seen;
  queue.schedule(at(1), EventOrder::trigger, [&] {
    seen += 't';
    queue.schedule(at(1), EventOrder::job, [&] { seen += 'j'; });
  });
  queue.schedule(at(1), EventOrder::governor, [&] { seen += 'g'; });
  queue.run([] { return false; });
  EXPECT_EQ(seen, "tjg");
}

TEST(EventQueue, repeats_without_drift_until_told_to_stop) {
  EventQueue queue;
  std::vector<MissionTime> ticks;
  queue.every(at(3), std::chrono::milliseconds{7}, EventOrder::physics,
              [&] { ticks.push_back(queue.now()); });
  queue.run([&] { return ticks.size() == 1000; });
  EXPECT_EQ(ticks.front(), at(3));
  EXPECT_EQ(ticks.back(), at(3 + 999 * 7));
}

TEST(EventQueue, a_step_without_events_says_so_and_keeps_the_time) {
  EventQueue queue;
  queue.schedule(at(4), EventOrder::job, [] {});
  EXPECT_TRUE(queue.step());
  EXPECT_FALSE(queue.step());
  EXPECT_EQ(queue.now(), at(4));
}

TEST(EventQueueDeathTest, the_past_cannot_be_changed) {
  EventQueue queue;
  queue.schedule(at(4), EventOrder::job, [] {});
  queue.step();
  EXPECT_DEATH(queue.schedule(at(3), EventOrder::job, [] {}), "now=0.004");
}

}  // namespace
}  // namespace flyball
