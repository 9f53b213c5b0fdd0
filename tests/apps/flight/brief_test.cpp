// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/brief.h"

#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Brief, body_grows_with_speed_by_the_tracking_tube) {
  const kit::GridMap map = kit::corridor(10.0);
  const kit::MissionRig rig{map};
  const double at_rest_m = rig.brief->body_at(0.0).radius_m;
  EXPECT_DOUBLE_EQ(at_rest_m, 0.325 + rig.brief->tube.at_rest_m);
  EXPECT_DOUBLE_EQ(rig.brief->body_at(5.0).radius_m, at_rest_m + 5.0 * rig.brief->tube.per_m_s);
}

TEST(Brief, has_arrived_as_near_as_the_vehicle_is_kept_to_its_reference) {
  Brief brief;
  EXPECT_DOUBLE_EQ(brief.arrival_error_m(), 0.1);
  brief.tube.at_rest_m = 0.5;
  EXPECT_DOUBLE_EQ(brief.arrival_error_m(), 0.5);
}

TEST(VehicleTopics, are_as_many_as_the_vehicle_serves) {
  Graph bare{"bare"};
  EXPECT_FALSE(add_vehicle_topics(bare).view.has_value());
  EXPECT_FALSE(bare.find<ColourFrame>("colour").has_value());
  Graph full{"full"};
  const VehicleTopics topics = add_vehicle_topics(full, {true, true, true, true});
  EXPECT_TRUE(topics.view && topics.imu && topics.true_pose);
  EXPECT_TRUE(full.find<GimbalAngles>("gimbal_command").has_value());
}

}  // namespace
}  // namespace flyball
