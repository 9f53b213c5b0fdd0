// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/graph.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Work idle(JobContext&) {
  return {};
}

Graph example() {
  Graph graph{"example"};
  const auto frame = graph.topic<int>("frame");
  const auto cloud = graph.topic<int>("cloud", 4);
  const auto command = graph.topic<double>("command");
  NodeSpec points;
  points.name = "points";
  points.cost = "depth_to_points";
  points.trigger = OnMessage{frame.index};
  points.writes = {cloud.index};
  graph.node(points, idle);
  NodeSpec tracker;
  tracker.name = "tracker";
  tracker.trigger = OnPeriod{std::chrono::milliseconds{20}, std::chrono::milliseconds{5}};
  tracker.priority = 3;
  tracker.deadline = std::chrono::microseconds{2500};
  tracker.on_miss = OnMiss::brake;
  tracker.threads = 2;
  tracker.reads = {cloud.index};
  tracker.writes = {command.index};
  graph.node(tracker, idle);
  return graph;
}

TEST(Graph, prints_every_node_and_topic_as_text) {
  EXPECT_EQ(
      example().to_text(),
      "graph example\n"
      "  node points: on frame, priority 0, cost depth_to_points\n"
      "    writes cloud\n"
      "  node tracker: every 20 ms from 5 ms, priority 3, deadline 2.5 ms (brake), 2 threads, "
      "cost none\n"
      "    reads cloud\n"
      "    writes command\n"
      "  topic frame: latest value\n"
      "  topic cloud: queue of 4\n"
      "  topic command: latest value\n");
}

TEST(Graph, draws_nodes_as_boxes_and_topics_as_edges) {
  EXPECT_EQ(example().to_dot(),
            "digraph \"example\" {\n"
            "  rankdir=LR;\n"
            "  node [shape=box];\n"
            "  \"points\" [label=\"points\\non frame\\npriority 0\"];\n"
            "  \"tracker\" [label=\"tracker\\nevery 20 ms from 5 ms\\npriority 3\\n"
            "deadline 2.5 ms (brake)\\n2 threads\"];\n"
            "  \"topic frame\" [label=\"frame\", shape=ellipse];\n"
            "  \"topic frame\" -> \"points\" [label=\"frame\"];\n"
            "  \"points\" -> \"tracker\" [label=\"cloud\", style=dashed];\n"
            "  \"topic command\" [label=\"command\", shape=ellipse];\n"
            "  \"tracker\" -> \"topic command\" [label=\"command\"];\n"
            "}\n");
}

TEST(Graph, a_service_is_a_request_and_a_response_queue) {
  Graph graph{"service"};
  const auto plan = graph.service<int, double>("plan", 2);
  ASSERT_EQ(graph.topics().size(), 2U);
  EXPECT_EQ(graph.topics()[0].name, "plan.request");
  EXPECT_EQ(graph.topics()[1].name, "plan.response");
  EXPECT_EQ(graph.topics()[1].capacity, 2U);
  EXPECT_EQ(plan.response.index, 1);
}

TEST(GraphDeathTest, refuses_what_cannot_run) {
  Graph graph = example();
  const auto add = [&graph](const std::function<void(NodeSpec&)>& spoil) {
    NodeSpec spec;
    spec.name = "new";
    spec.trigger = OnPeriod{std::chrono::milliseconds{1}, {}};
    spoil(spec);
    graph.node(spec, idle);
  };
  EXPECT_DEATH(add([](NodeSpec& spec) { spec.name = "points"; }), "two nodes \"points\"");
  EXPECT_DEATH(add([](NodeSpec& spec) { spec.threads = 0; }), "threads=0");
  EXPECT_DEATH(add([](NodeSpec& spec) { spec.trigger = OnPeriod{}; }), "period 0 s");
  EXPECT_DEATH(add([](NodeSpec& spec) { spec.trigger = OnMessage{3}; }), "trigger topic 3");
  EXPECT_DEATH(add([](NodeSpec& spec) { spec.writes = {-1}; }), "does not exist");
  EXPECT_DEATH(graph.topic<int>("cloud"), "two topics \"cloud\"");
  EXPECT_DEATH(graph.topic<int>("full", 0), "has no room");
}

}  // namespace
}  // namespace flyball
