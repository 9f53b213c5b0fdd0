// SPDX-License-Identifier: BSD-3-Clause
//
// Jobs on an edge computer, by hand: a message of the rig has 4 bytes, which are one packet of 82
// on the way, and the link takes 1 ms for it.

#include "computer_rig.h"
#include <array>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double message_bits = 8.0 * (4.0 + 78.0);

/// Three times as fast as the rig's platform, 2 ms away.
EdgeModel edge_of(int cores) {
  EdgeModel edge;
  edge.platform = std::make_shared<const ModeledPlatform>(rig_model(0.0));
  edge.point = {cores, Hertz{1e9}};
  edge.speed_factor = 3.0;
  edge.link.bandwidth_bit_s = 1e3 * message_bits;
  edge.link.latency = at_ms(2.0).time_since_epoch();
  return edge;
}

void start_with_edge(ComputerRig& rig, int cores) {
  rig.start(1);
  rig.computer->connect_edge(edge_of(cores));
}

TEST(Offloading, a_job_takes_the_way_there_its_time_there_and_the_way_back) {
  ComputerRig rig;
  const int a = rig.add({30.0});
  start_with_edge(rig, 4);
  rig.computer->place(a, true);
  rig.trigger(a, 5.0);
  rig.run();
  EXPECT_EQ(rig.of(a).started, at_ms(5.0));
  EXPECT_NEAR(rig.end_ms(a), 5.0 + 3.0 + 30.0 / 3.0 + 3.0, end_tolerance_ms);
  EXPECT_EQ(rig.of(a).busy, Duration::zero());
}

TEST(Offloading, nobody_hears_of_it_before_its_outputs_have_arrived) {
  ComputerRig rig;
  const int a = rig.add({30.0});
  start_with_edge(rig, 4);
  rig.computer->place(a, true);
  std::vector<double> heard_ms;
  rig.computer->subscribe<int>(rig.outputs[0],
                               [&](const int&) { heard_ms.push_back(ms(rig.queue.now())); });
  rig.trigger(a, 0.0);
  rig.run();
  ASSERT_EQ(heard_ms.size(), 1U);
  EXPECT_NEAR(heard_ms[0], 16.0, end_tolerance_ms);
}

TEST(Offloading, the_core_on_board_is_free_meanwhile) {
  ComputerRig rig;
  const int far = rig.add({30.0, 1});
  const int near = rig.add({12.0});
  start_with_edge(rig, 4);
  rig.computer->place(far, true);
  rig.trigger(far, 0.0);
  rig.trigger(near, 0.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(near), 12.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(far), 16.0, end_tolerance_ms);
  EXPECT_NEAR(rig.computer->busy_core_s(), 12e-3, 1e-8);
}

TEST(Offloading, jobs_share_the_edge_computer_and_the_link) {
  ComputerRig rig;
  const int a = rig.add({30.0});
  const int b = rig.add({30.0});
  start_with_edge(rig, 1);
  rig.computer->place(a, true);
  rig.computer->place(b, true);
  rig.trigger(a, 0.0);
  rig.trigger(b, 0.0);
  rig.run();
  // Inputs arrive at 3 and 4 ms. From 4 ms on both share one core: a has 9 of 10 ms left, so that
  // it is done at 22 ms, and b, which has 1 ms left then, at 23. Outputs take 3 ms each.
  EXPECT_NEAR(rig.end_ms(a), 25.0, 3.0 * end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(b), 26.0, 3.0 * end_tolerance_ms);
}

TEST(Offloading, a_node_moves_between_two_of_its_jobs) {
  ComputerRig rig;
  const int a = rig.add({30.0, 0, "serial", 1, 0.0, OnMiss::warn, 4});
  start_with_edge(rig, 4);
  rig.trigger(a, 0.0);
  rig.queue.schedule(at_ms(10.0), EventOrder::governor, [&] { rig.computer->place(a, true); });
  rig.trigger(a, 50.0);
  rig.queue.schedule(at_ms(55.0), EventOrder::governor, [&] { rig.computer->place(a, false); });
  rig.trigger(a, 100.0);
  rig.run();
  ASSERT_EQ(rig.records.size(), 3U);
  EXPECT_NEAR(ms(rig.records[0].ended), 30.0, end_tolerance_ms);
  // What it told on board goes with its first job: 8 bytes in one packet.
  const double state_ms = 4.0 * 8.0 / message_bits;
  EXPECT_NEAR(ms(rig.records[1].ended), 66.0 + state_ms, 3.0 * end_tolerance_ms);
  EXPECT_NEAR(ms(rig.records[2].ended), 130.0, end_tolerance_ms);
}

TEST(Offloading, a_message_is_sent_once) {
  Graph graph{"two readers"};
  const auto in = graph.topic<int>("in");
  const auto big = graph.topic<std::array<char, 1000>>("big");
  std::vector<double> ended_ms;
  NodeSpec spec;
  spec.name = "reader";
  spec.cost = "serial";
  spec.trigger = OnMessage{in.index};
  spec.reads = {big.index};
  graph.node(spec, [=](JobContext& job) {
    (void)job.latest(in);
    (void)job.latest(big);
    Work work;
    work.add("ms", 30.0);
    return work;
  });
  const ModeledPlatform platform{rig_model(0.0)};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{1e9}}};
  computer.connect_edge(edge_of(1));
  computer.place(0, true);
  computer.on_job([&](const JobRecord& job) { ended_ms.push_back(ms(job.ended - job.started)); });
  computer.publish(big, std::array<char, 1000>{});
  computer.publish(in, 1);
  queue.run([] { return false; });
  computer.publish(in, 2);
  queue.run([] { return false; });
  ASSERT_EQ(ended_ms.size(), 2U);
  // Nothing is published: what comes back is an empty packet.
  const double back_ms = 2.0 + 8.0 * 78.0 / message_bits;
  const double again_ms = 3.0 + 10.0 + back_ms;
  EXPECT_NEAR(ended_ms[0], again_ms + 8000.0 / message_bits, 3.0 * end_tolerance_ms);
  EXPECT_NEAR(ended_ms[1], again_ms, 3.0 * end_tolerance_ms);
}

TEST(Offloading, the_clock_on_board_does_not_matter_on_the_edge) {
  ComputerRig rig{5.0};
  const int a = rig.add({30.0});
  start_with_edge(rig, 4);
  rig.computer->place(a, true);
  rig.trigger(a, 0.0);
  rig.set_point(4.0, 1, 0.5);
  rig.run();
  EXPECT_NEAR(rig.end_ms(a), 16.0, end_tolerance_ms);
}

TEST(Offloading, a_job_that_misses_its_deadline_on_the_way_is_killed) {
  ComputerRig rig;
  const int a = rig.add({30.0, 0, "serial", 1, 14.0, OnMiss::skip});
  start_with_edge(rig, 4);
  rig.computer->place(a, true);
  rig.trigger(a, 0.0);
  rig.run();
  EXPECT_TRUE(rig.of(a).killed);
  EXPECT_EQ(rig.of(a).ended, at_ms(14.0));
}

TEST(Offloading, the_radio_works_as_long_as_packets_are_on_the_air) {
  ComputerRig rig;
  const int a = rig.add({30.0});
  start_with_edge(rig, 4);
  rig.computer->place(a, true);
  rig.trigger(a, 0.0);
  rig.run();
  EXPECT_NEAR(rig.computer->device_use().sending_s, 1e-3, 1e-8);
  EXPECT_NEAR(rig.computer->device_use().receiving_s, 1e-3, 1e-8);
}

TEST(Offloading, without_an_edge_computer_jobs_stay_on_board) {
  ComputerRig rig;
  const int a = rig.add({30.0});
  rig.start(1);
  rig.computer->place(a, true);
  rig.trigger(a, 0.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(a), 30.0, end_tolerance_ms);
}

}  // namespace
}  // namespace flyball
