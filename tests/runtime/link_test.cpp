// SPDX-License-Identifier: BSD-3-Clause
#include "link.h"

#include "computer_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

// A packet has 1460 bytes and 78 more on the way: 12.304 ms at 1 Mbit/s.
constexpr double packet_ms = 12.304;
constexpr double rounded_ms = 1e-5;

LinkModel one_megabit() {
  LinkModel model;
  model.bandwidth_bit_s = 1e6;
  return model;
}

TEST(Link, a_message_takes_its_bytes_over_the_bandwidth_and_the_latency) {
  LinkModel model = one_megabit();
  model.latency = at_ms(5.0).time_since_epoch();
  Link link{model, 1, "uplink"};
  EXPECT_NEAR(ms(link.send(at_ms(100.0), 10.0 * 1460.0)), 105.0 + 10.0 * packet_ms, rounded_ms);
}

TEST(Link, a_message_without_content_still_is_a_packet) {
  Link link{one_megabit(), 1, "uplink"};
  EXPECT_NEAR(ms(link.send(at_ms(0.0), 0.0)), 8.0 * 78.0 / 1e3, rounded_ms);
}

TEST(Link, messages_queue_for_the_bandwidth_but_not_for_the_latency) {
  LinkModel model = one_megabit();
  model.latency = at_ms(50.0).time_since_epoch();
  Link link{model, 1, "uplink"};
  EXPECT_NEAR(ms(link.send(at_ms(0.0), 1460.0)), 50.0 + packet_ms, rounded_ms);
  EXPECT_NEAR(ms(link.send(at_ms(1.0), 1460.0)), 50.0 + 2.0 * packet_ms, rounded_ms);
  EXPECT_NEAR(ms(link.send(at_ms(200.0), 1460.0)), 250.0 + packet_ms, rounded_ms);
}

TEST(Link, jitter_is_drawn_from_the_seed_and_stays_within_its_bound) {
  LinkModel model = one_megabit();
  model.jitter = at_ms(8.0).time_since_epoch();
  Link link{model, 7, "uplink"};
  Link same{model, 7, "uplink"};
  Link other{model, 8, "uplink"};
  double least_ms = 1e9;
  double most_ms = 0.0;
  bool differs = false;
  for (int i = 0; i < 200; ++i) {
    const MissionTime now = at_ms(100.0 * i);
    const MissionTime arrival = link.send(now, 1460.0);
    EXPECT_EQ(arrival, same.send(now, 1460.0));
    differs = differs || arrival != other.send(now, 1460.0);
    least_ms = std::min(least_ms, ms(arrival - now) - packet_ms);
    most_ms = std::max(most_ms, ms(arrival - now) - packet_ms);
  }
  EXPECT_TRUE(differs);
  EXPECT_GE(least_ms, 0.0);
  EXPECT_LT(least_ms, 1.0);
  EXPECT_GT(most_ms, 7.0);
  EXPECT_LE(most_ms, 8.0 + rounded_ms);
}

TEST(Link, what_is_lost_is_sent_again_after_the_time_out) {
  LinkModel model = one_megabit();
  model.loss = 0.5;
  model.timeout = at_ms(200.0).time_since_epoch();
  Link link{model, 3, "uplink"};
  double rounds = 0.0;
  double resent = 0.0;
  constexpr int messages = 400;
  MissionTime now = at_ms(0.0);
  for (int i = 0; i < messages; ++i) {
    const double took_ms = ms(link.send(now, 1460.0) - now);
    // One packet: every loss costs a time-out and one more packet.
    const double again = (took_ms - packet_ms) / (200.0 + packet_ms);
    EXPECT_NEAR(again, std::round(again), 1e-6);
    rounds += again > 0.5 ? 1.0 : 0.0;
    resent += again;
    now += at_ms(1e5).time_since_epoch();
  }
  // Half of the messages are lost at first, and each is sent once more on average: p / (1 - p).
  // Four standard deviations of 400 draws are .1 and .28.
  EXPECT_NEAR(rounds / messages, 0.5, 0.1);
  EXPECT_NEAR(resent / messages, 1.0, 0.28);
}

TEST(Link, what_is_sent_again_is_as_long_as_what_was_lost) {
  LinkModel model = one_megabit();
  model.loss = 0.5;
  model.timeout = at_ms(200.0).time_since_epoch();
  Link link{model, 3, "uplink"};
  constexpr double pose_ms = 8.0 * (100.0 + 78.0) / 1e3;  // Of 100 bytes.
  double most_rounds = 0.0;
  MissionTime now = at_ms(0.0);
  for (int i = 0; i < 20; ++i) {
    const double took_ms = ms(link.send(now, 100.0) - now);
    const double again = (took_ms - pose_ms) / (200.0 + pose_ms);
    EXPECT_NEAR(again, std::round(again), 1e-6);
    most_rounds = std::max(most_rounds, again);
    now += at_ms(1e5).time_since_epoch();
  }
  EXPECT_GT(most_rounds, 0.5);
}

TEST(Link, time_on_air_grows_while_packets_are_sent_and_no_longer) {
  Link link{one_megabit(), 1, "uplink"};
  (void)link.send(at_ms(100.0), 1460.0);
  EXPECT_EQ(link.on_air_s(at_ms(100.0)), 0.0);
  EXPECT_NEAR(link.on_air_s(at_ms(100.0 + 0.25 * packet_ms)), 0.25e-3 * packet_ms, 1e-8);
  EXPECT_NEAR(link.on_air_s(at_ms(500.0)), 1e-3 * packet_ms, 1e-8);
  (void)link.send(at_ms(600.0), 1460.0);
  EXPECT_NEAR(link.on_air_s(at_ms(700.0)), 2e-3 * packet_ms, 1e-8);
}

}  // namespace
}  // namespace flyball
