// SPDX-License-Identifier: BSD-3-Clause
//
// Messages and outputs on the modeled computer.

#include "computer_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::vector<double> released_ms(const ComputerRig& rig) {
  std::vector<double> times;
  for (const JobRecord& record : rig.records) {
    times.push_back(ms(record.released));
  }
  return times;
}

TEST(VirtualExecutor, outputs_are_invisible_until_the_job_ends) {
  ComputerRig rig;
  const int a = rig.add({100.0});
  rig.start(1);
  std::vector<double> heard_ms;
  rig.computer->subscribe<int>(rig.outputs[0],
                               [&](const int&) { heard_ms.push_back(ms(rig.queue.now())); });
  rig.trigger(a, 5.0);
  rig.run();
  EXPECT_EQ(heard_ms, (std::vector<double>{105.0}));
}

TEST(VirtualExecutor, at_end_runs_before_publications_wake_nodes_then_listeners) {
  Graph graph{"order"};
  const auto in = graph.topic<int>("in");
  const auto out = graph.topic<int>("out");
  std::vector<std::string> order;
  const auto note = [&order](std::string what) {
    return [&order, what](MissionTime) { order.push_back(what); };
  };
  NodeSpec writer;
  writer.name = "writer";
  writer.trigger = OnMessage{in.index};
  writer.writes = {out.index};
  graph.node(writer, [&](JobContext& job) {
    job.publish(out, 1);
    job.at_end(note("end 1"));
    job.at_end(note("end 2"));
    return Work{};
  });
  NodeSpec reader;
  reader.name = "reader";
  reader.trigger = OnMessage{out.index};
  graph.node(reader, [&](JobContext& job) {
    order.push_back("reader saw " + std::to_string(*job.latest(out)));
    return Work{};
  });
  const ModeledPlatform platform{rig_model(0.0)};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{1e9}}};
  computer.subscribe<int>(out, [&](const int&) { order.push_back("first listener"); });
  computer.subscribe<int>(out, [&](const int&) { order.push_back("second listener"); });
  computer.publish(in, 0);
  queue.run([] { return false; });
  EXPECT_EQ(order, (std::vector<std::string>{"end 1", "end 2", "first listener", "second listener",
                                             "reader saw 1"}));
  EXPECT_EQ(queue.now(), MissionTime{});  // nothing in this graph costs time
}

TEST(VirtualExecutor, an_overtaken_latest_value_is_dropped_and_counted) {
  ComputerRig rig;
  const int a = rig.add({100.0});
  rig.start(1);
  rig.trigger(a, 0.0, 1);
  rig.trigger(a, 20.0, 2);
  rig.trigger(a, 60.0, 3);
  rig.run();
  EXPECT_EQ(rig.taken, (std::vector<int>{1, 3}));
  EXPECT_EQ(released_ms(rig), (std::vector<double>{0.0, 60.0}));
  EXPECT_EQ(rig.records[1].started, at_ms(100.0));
  EXPECT_EQ(rig.computer->drops(), 1U);
}

TEST(VirtualExecutor, a_job_that_still_waits_reads_the_newest_message_once) {
  ComputerRig rig;
  const int low = rig.add({10.0, 0});
  const int high = rig.add({100.0, 1});
  rig.start(1);
  rig.trigger(high, 0.0, -7);
  rig.trigger(low, 10.0, 1);
  rig.trigger(low, 20.0, 2);
  rig.run();
  EXPECT_EQ(rig.taken, (std::vector<int>{-7, 2}));
  EXPECT_EQ(rig.of(low).released, at_ms(10.0));
  EXPECT_EQ(rig.computer->drops(), 1U);
}

TEST(VirtualExecutor, a_queue_starts_one_job_per_message_in_order) {
  ComputerRig rig;
  const int a = rig.add({100.0, 0, "serial", 1, 0.0, OnMiss::warn, 4});
  rig.start(1);
  for (int i = 0; i < 4; ++i) {
    rig.trigger(a, 10.0 * i, i);
  }
  rig.run();
  EXPECT_EQ(rig.taken, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(released_ms(rig), (std::vector<double>{0.0, 10.0, 20.0, 30.0}));
  EXPECT_EQ(rig.records.back().ended, at_ms(400.0));
  EXPECT_EQ(rig.computer->drops(), 0U);
}

TEST(VirtualExecutor, a_full_queue_drops_its_oldest_message) {
  ComputerRig rig;
  const int a = rig.add({100.0, 0, "serial", 1, 0.0, OnMiss::warn, 2});
  rig.start(1);
  for (int i = 0; i < 5; ++i) {
    rig.trigger(a, 10.0 * i, i);
  }
  rig.run();
  EXPECT_EQ(rig.taken, (std::vector<int>{0, 3, 4}));
  EXPECT_EQ(rig.computer->drops(), 2U);
}

TEST(VirtualExecutor, two_readers_of_a_queue_each_get_every_message) {
  Graph graph{"fan out"};
  const auto queue_topic = graph.topic<int>("queue", 3);
  std::vector<std::vector<int>> seen(2);
  for (std::size_t i = 0; i < 2; ++i) {
    NodeSpec spec;
    spec.name = "reader" + std::to_string(i);
    spec.trigger = OnMessage{queue_topic.index};
    graph.node(spec, [&seen, i, queue_topic](JobContext& job) {
      seen[i].push_back(*job.take(queue_topic));
      return Work{};
    });
  }
  const ModeledPlatform platform{rig_model(0.0)};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{1e9}}};
  computer.publish(queue_topic, 4);
  computer.publish(queue_topic, 5);
  queue.run([] { return false; });
  EXPECT_EQ(seen[0], (std::vector<int>{4, 5}));
  EXPECT_EQ(seen[1], (std::vector<int>{4, 5}));
}

TEST(VirtualExecutor, a_latest_value_is_taken_once_but_stays_readable) {
  Graph graph{"once"};
  const auto tick = graph.topic<int>("tick", 4);
  const auto value = graph.topic<int>("value");
  std::vector<std::pair<bool, int>> seen;
  NodeSpec spec;
  spec.name = "reader";
  spec.trigger = OnMessage{tick.index};
  spec.reads = {value.index};
  graph.node(spec, [&](JobContext& job) {
    const bool is_new = job.take(value) != nullptr;
    seen.emplace_back(is_new, job.latest(value) ? *job.latest(value) : -1);
    return Work{};
  });
  const ModeledPlatform platform{rig_model(0.0)};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{1e9}}};
  const auto tick_at = [&](double when_ms) {
    queue.schedule(at_ms(when_ms), EventOrder::sensor, [&] { computer.publish(tick, 0); });
  };
  tick_at(1.0);
  queue.schedule(at_ms(2.0), EventOrder::sensor, [&] {
    computer.publish(value, 8);
    computer.publish(value, 9);
  });
  tick_at(3.0);
  tick_at(4.0);
  queue.run([] { return false; });
  EXPECT_EQ(seen, (std::vector<std::pair<bool, int>>{{false, -1}, {true, 9}, {false, 9}}));
  EXPECT_EQ(computer.drops(), 0U);  // values that are only looked at are not dropped triggers
}

TEST(VirtualExecutor, a_period_that_begins_while_its_node_is_busy_is_dropped) {
  Graph graph{"periodic"};
  std::vector<double> started_ms;
  NodeSpec spec;
  spec.name = "slow";
  spec.cost = "serial";
  spec.trigger = OnPeriod{std::chrono::milliseconds{10}, std::chrono::milliseconds{5}};
  graph.node(spec, [&](JobContext& job) {
    started_ms.push_back(ms(job.now()));
    Work work;
    work.add("ms", 14.0);
    return work;
  });
  const ModeledPlatform platform{rig_model(0.0)};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{1e9}}};
  queue.run([&] { return queue.now() >= at_ms(60.0); });
  EXPECT_EQ(started_ms, (std::vector<double>{5.0, 25.0, 45.0}));
  EXPECT_EQ(computer.drops(), 3U);  // at 15, 35 and 55 ms
}

TEST(VirtualExecutor, a_node_that_triggers_itself_runs_again) {
  Graph graph{"loop"};
  const auto count = graph.topic<int>("count");
  NodeSpec spec;
  spec.name = "counter";
  spec.cost = "serial";
  spec.trigger = OnMessage{count.index};
  spec.writes = {count.index};
  graph.node(spec, [&](JobContext& job) {
    const int n = *job.take(count);
    if (n < 5) {
      job.publish(count, n + 1);
    }
    Work work;
    work.add("ms", 2.0);
    return work;
  });
  const ModeledPlatform platform{rig_model(0.0)};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{1e9}}};
  computer.publish(count, 1);
  queue.run([] { return false; });
  EXPECT_EQ(queue.now(), at_ms(10.0));
  EXPECT_EQ(computer.drops(), 0U);
}

TEST(VirtualExecutor, a_job_whose_work_names_a_kernel_takes_as_long_as_that_one) {
  Graph graph{"exchanged"};
  const auto in = graph.topic<int>("in");
  NodeSpec spec;
  spec.name = "either";
  spec.cost = "serial";
  spec.trigger = OnMessage{in.index};
  graph.node(spec, [&](JobContext& job) {
    Work work;
    work.add("ms", 100.0);
    if (*job.latest(in) == 2) {
      work.charge_as("memory");  // At 2 GHz half of its time stays.
    }
    return work;
  });
  const ModeledPlatform platform{rig_model(0.0)};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{2e9}}};
  computer.publish(in, 1);
  queue.run([] { return false; });
  EXPECT_EQ(queue.now(), at_ms(50.0));
  computer.publish(in, 2);
  queue.run([] { return false; });
  EXPECT_NEAR(to_seconds(queue.now()), 0.05 + 0.075, 1e-6);
}

TEST(VirtualExecutor, may_be_gone_before_its_events_are_due) {
  ComputerRig rig;
  const int a = rig.add({100.0, 0, "serial", 1, 50.0});
  rig.start(1);
  rig.trigger(a, 0.0);
  rig.queue.run([&] { return !rig.taken.empty(); });
  rig.computer.reset();
  rig.run();  // the end and the deadline are still in the queue
  EXPECT_EQ(rig.queue.now(), at_ms(100.0));
  EXPECT_TRUE(rig.records.empty());
}

TEST(VirtualExecutor, starts_and_ends_no_job_once_it_has_stopped) {
  ComputerRig rig;
  const int a = rig.add({100.0, 0, "serial", 1, 50.0});
  const int b = rig.add({10.0});
  rig.start(1);
  rig.trigger(a, 0.0);
  rig.queue.run([&] { return !rig.taken.empty(); });
  const std::size_t taken = rig.taken.size();
  rig.computer->stop();
  rig.trigger(b, 0.0);
  rig.run();
  EXPECT_EQ(rig.taken.size(), taken);
  EXPECT_TRUE(rig.records.empty());
}

TEST(VirtualExecutorDeathTest, a_topic_that_the_node_does_not_declare_is_out_of_reach) {
  Graph graph{"undeclared"};
  const auto in = graph.topic<int>("in");
  const auto secret = graph.topic<int>("secret");
  NodeSpec spec;
  spec.name = "peeper";
  spec.trigger = OnMessage{in.index};
  graph.node(spec, [&](JobContext& job) {
    (void)job.latest(secret);
    return Work{};
  });
  const ModeledPlatform platform{rig_model(0.0)};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{1e9}}};
  computer.publish(in, 0);
  EXPECT_DEATH(queue.run([] { return false; }), "peeper does not declare that it reads");
}

}  // namespace
}  // namespace flyball
