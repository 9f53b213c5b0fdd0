// SPDX-License-Identifier: BSD-3-Clause
#include "message_exchange.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at_ms(int ms) {
  return MissionTime{std::chrono::milliseconds{ms}};
}

/// A node that messages on a queue of two start, and which also reads a latest value.
struct Exchange {
  Exchange() {
    NodeSpec spec;
    spec.name = "node";
    spec.trigger = OnMessage{in.index};
    spec.reads = {pose.index};
    graph.node(spec, [](JobContext&) { return Work{}; });
    exchange.emplace(graph);
    job.emplace(graph.nodes().front().spec, nullptr);
    exchange->equip(0, *job);
  }
  const std::vector<int>& put(Topic<int> topic, int value, int ms) {
    return exchange->put(topic.index, make_message(nullptr, value), at_ms(ms));
  }
  int taken() {
    const auto message = job->take(in);
    return message ? *message : -1;
  }

  Graph graph{"exchange"};
  Topic<int> in{graph.topic<int>("in", 2)};
  Topic<int> pose{graph.topic<int>("pose")};
  std::optional<MessageExchange> exchange{};
  std::optional<NodeJob> job{};
};

TEST(MessageExchange, names_the_nodes_that_a_message_starts) {
  Exchange rig;
  EXPECT_EQ(rig.put(rig.in, 1, 5), std::vector<int>{0});
  EXPECT_TRUE(rig.put(rig.pose, 1, 6).empty());
  EXPECT_EQ(rig.exchange->owed_since(0), at_ms(5));
  rig.exchange->drop_trigger(0);
  EXPECT_EQ(rig.exchange->owed_since(0), std::nullopt);
}

TEST(MessageExchange, a_job_keeps_the_messages_that_it_began_with) {
  Exchange rig;
  (void)rig.put(rig.pose, 10, 1);
  (void)rig.put(rig.in, 1, 2);
  rig.exchange->open(0, *rig.job);
  (void)rig.put(rig.pose, 11, 3);
  (void)rig.put(rig.in, 2, 4);
  EXPECT_EQ(*rig.job->latest(rig.pose), 10);
  EXPECT_EQ(rig.taken(), 1);
  EXPECT_EQ(rig.taken(), -1);
  rig.job->note_questions();
  EXPECT_EQ(rig.job->record.reads, (std::vector<MessageVersion>{
                                       {rig.pose.index, 1}, {rig.in.index, 1}, {rig.in.index, 0}}));
  rig.exchange->close(0, *rig.job);
  EXPECT_EQ(rig.exchange->owed_since(0), at_ms(4));
  rig.job->renew();
  rig.exchange->open(0, *rig.job);
  EXPECT_EQ(*rig.job->latest(rig.pose), 11);
  EXPECT_EQ(rig.taken(), 2);
}

TEST(MessageExchange, what_a_job_did_not_read_stands_before_what_arrived_since) {
  Exchange rig;
  (void)rig.put(rig.in, 1, 1);
  (void)rig.put(rig.in, 2, 2);
  rig.exchange->open(0, *rig.job);
  EXPECT_EQ(rig.taken(), 1);
  (void)rig.put(rig.in, 3, 3);
  (void)rig.put(rig.in, 4, 4);
  EXPECT_EQ(rig.exchange->drops(), 0U);
  rig.exchange->close(0, *rig.job);
  EXPECT_EQ(rig.exchange->drops(), 1U);  // Of 2, 3 and 4, two have room.
  rig.job->renew();
  rig.exchange->open(0, *rig.job);
  EXPECT_EQ(rig.taken(), 3);
  EXPECT_EQ(rig.taken(), 4);
}

TEST(MessageExchange, a_job_that_takes_nothing_uses_up_its_trigger) {
  Exchange rig;
  (void)rig.put(rig.in, 1, 1);
  rig.exchange->open(0, *rig.job);
  rig.exchange->close(0, *rig.job);
  EXPECT_EQ(rig.exchange->owed_since(0), std::nullopt);
}

TEST(MessageExchange, an_overtaken_trigger_counts_as_dropped_and_a_latest_value_does_not) {
  Exchange rig;
  for (int i = 0; i < 5; ++i) {
    (void)rig.put(rig.pose, i, i);
  }
  EXPECT_EQ(rig.exchange->drops(), 0U);
  for (int i = 0; i < 5; ++i) {
    (void)rig.put(rig.in, i, i);
  }
  EXPECT_EQ(rig.exchange->drops(), 3U);
}

TEST(NodeJob, counts_its_questions_and_stops_where_it_is_told) {
  NodeSpec spec;
  NodeJob job{spec, nullptr};
  job.renew();
  EXPECT_FALSE(job.should_stop());
  EXPECT_FALSE(job.should_stop());
  job.is_told_to_stop = true;
  EXPECT_TRUE(job.should_stop());
  EXPECT_TRUE(job.should_stop());
  job.note_questions();
  EXPECT_EQ(job.record.questions_before_stop, 2U);
  job.renew();
  job.stop_after = 1;
  EXPECT_FALSE(job.should_stop());
  EXPECT_TRUE(job.should_stop());
}

}  // namespace
}  // namespace flyball
