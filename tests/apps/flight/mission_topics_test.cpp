// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/mission_topics.h"

#include "flyball/runtime/modeled/virtual_executor.h"

#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(KnobsInForce, the_slowest_zone_and_the_knob_limit_the_speed) {
  const kit::GridMap map = kit::corridor(10.0);
  const kit::MissionRig rig{map};
  Site site;
  site.zones = {{{Vec3{0, 0, 0}, Vec3{2, 2, 2}}, 3.0}, {{Vec3{1, 0, 0}, Vec3{2, 2, 2}}, 1.0}};
  EXPECT_DOUBLE_EQ(rig.knobs->speed_limit_m_s(site, Vec3{0.5, 1, 1}), 3.0);
  EXPECT_DOUBLE_EQ(rig.knobs->speed_limit_m_s(site, Vec3{1.5, 1, 1}), 1.0);
  EXPECT_DOUBLE_EQ(rig.knobs->speed_limit_m_s(site, Vec3{9, 1, 1}),
                   rig.scenario.mission.max_speed_m_s);
}

TEST(Finish, keeps_the_first_end_only_and_records_it) {
  const kit::GridMap map = kit::corridor(10.0);
  const kit::MissionRig rig{map};
  EventQueue queue;
  Graph graph{"mission"};
  MemoryRecorder trace;
  const MissionTopics topics = add_mission_topics(graph);
  add_finish(graph, topics);
  add_record(graph, topics, trace);
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  std::vector<MissionEnd> outcomes;
  executor.subscribe<MissionEnd>(topics.outcome,
                                 [&](const MissionEnd& end) { outcomes.push_back(end); });
  executor.publish(topics.end, MissionEnd{{}, MissionStatus::failed, MissionFailure::collision});
  executor.publish(topics.end, MissionEnd{{}, MissionStatus::succeeded, MissionFailure::none});
  queue.run([] { return false; });
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes.front().failure, MissionFailure::collision);
  ASSERT_EQ(trace.rows().size(), 1U);
  EXPECT_EQ(std::get<std::string>(trace.rows().front().fields.front().value),
            "end: failed by collision");
}

}  // namespace
}  // namespace flyball
