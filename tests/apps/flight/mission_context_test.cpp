// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/mission_context.h"

#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(MissionContext, keeps_the_first_end_only) {
  const kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  EXPECT_FALSE(rig.context->is_over());
  rig.context->finish(MissionTime{}, MissionStatus::failed, MissionFailure::collision);
  rig.context->finish(MissionTime{}, MissionStatus::succeeded, MissionFailure::none);
  EXPECT_EQ(rig.context->status(), MissionStatus::failed);
  EXPECT_EQ(rig.context->failure(), MissionFailure::collision);
}

TEST(MissionContext, body_grows_with_speed_by_the_tracking_tube) {
  const kit::GridMap map = kit::corridor(10.0);
  const kit::MissionRig rig{map};
  const double at_rest_m = rig.context->body_at(0.0).radius_m;
  EXPECT_DOUBLE_EQ(at_rest_m, 0.325 + rig.context->tube.at_rest_m);
  EXPECT_DOUBLE_EQ(rig.context->body_at(5.0).radius_m, at_rest_m + 5.0 * rig.context->tube.per_m_s);
}

TEST(MissionContext, the_slowest_zone_and_the_knob_limit_the_speed) {
  const kit::GridMap map = kit::corridor(10.0);
  const kit::MissionRig rig{map};
  MissionBrief brief;
  brief.zones = {{{Vec3{0, 0, 0}, Vec3{2, 2, 2}}, 3.0}, {{Vec3{1, 0, 0}, Vec3{2, 2, 2}}, 1.0}};
  MissionEquipment equipment;
  equipment.knobs = KnobSettings{standard_knobs(rig.scenario, rig.platform).value()};
  MemoryRecorder trace;
  const MissionContext context{flight_settings(rig.scenario), rig.platform, trace, brief,
                               std::move(equipment)};
  EXPECT_DOUBLE_EQ(context.speed_limit_m_s(Vec3{0.5, 1, 1}), 3.0);
  EXPECT_DOUBLE_EQ(context.speed_limit_m_s(Vec3{1.5, 1, 1}), 1.0);
  EXPECT_DOUBLE_EQ(context.speed_limit_m_s(Vec3{9, 1, 1}), rig.scenario.mission.max_speed_m_s);
}

}  // namespace
}  // namespace flyball
