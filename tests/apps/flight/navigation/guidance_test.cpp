// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/guidance.h"

#include "flyball/runtime/modeled/virtual_executor.h"

#include "mission_rig.h"
#include <chrono>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(Guidance, believes_no_state_from_before_its_last_command) {
  EventQueue queue;
  Graph graph{"guidance"};
  const GuidanceTopics topics{graph.topic<GuidanceCommand>("guidance", 8),
                              graph.topic<NavigatorState>("navigator")};
  Guidance guidance{topics};
  std::vector<bool> knows;
  NodeSpec spec;
  spec.name = "mission";
  spec.trigger = OnPeriod{100ms, 100ms};
  guidance.declare(spec);
  graph.node(std::move(spec), [&](JobContext& job) {
    if (knows.empty()) {
      guidance.go_to_view(job, Vec3{4.0, 5.0, 6.0}, 0.5);
      guidance.go_to(job, Vec3{1.0, 2.0, 3.0});
    }
    knows.push_back(guidance.state(job) != nullptr);
    return Work{};
  });
  const ModeledPlatform platform{kit::free_of_charge()};
  VirtualExecutor executor{graph, platform, queue, {1, Hertz{1e9}}};
  std::vector<GuidanceCommand> commands;
  executor.subscribe<GuidanceCommand>(
      topics.command, [&](const GuidanceCommand& command) { commands.push_back(command); });
  executor.publish(topics.state, NavigatorState{});
  queue.run([&] { return queue.now() >= MissionTime{150ms}; });
  NavigatorState heard;
  heard.obeyed = 2;
  executor.publish(topics.state, heard);
  queue.run([&] { return queue.now() >= MissionTime{250ms}; });
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands.back().number, 2U);
  EXPECT_EQ(std::get<GoTo>(commands.back().what).p_W, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_FALSE(std::get<GoTo>(commands.back().what).is_one_of_many);
  EXPECT_TRUE(std::get<GoTo>(commands.front().what).is_one_of_many)
      << "an explorer has other views";
  ASSERT_GE(knows.size(), 2U);
  EXPECT_FALSE(knows.front());
  EXPECT_TRUE(knows.back());
}

}  // namespace
}  // namespace flyball
