// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/seeing_setup.h"

#include "flyball/simulation/mission.h"

#include "grid_map.h"
#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(SeeingSetup, gives_a_workload_that_looks_for_nobody_no_camera) {
  const Scenario scenario;
  const ModeledPlatform platform{kit::free_of_charge()};
  MissionEquipment equipment;
  ASSERT_TRUE(equip_to_see(scenario, platform, World{}, equipment).ok());
  EXPECT_EQ(equipment.colour_camera, nullptr);
  EXPECT_EQ(equipment.kernels.detector, nullptr);
}

TEST(SeeingSetup, gives_a_localizer_that_sees_an_eye_when_it_has_a_price) {
  Scenario scenario;
  scenario.kernels.localizer = "visual_slam";
  PlatformModel model{kit::free_of_charge()};
  MissionEquipment equipment;
  equipment.kernels.localizer = all_plugins().make<Localizer>("visual_slam");
  const Status unpriced = equip_to_see(scenario, ModeledPlatform{model}, World{}, equipment);
  ASSERT_FALSE(unpriced.ok());
  EXPECT_NE(unpriced.error().message.find("[kernels.visual_slam_frames]"), std::string::npos);
  EXPECT_EQ(equipment.eye, nullptr);
  model.kernels["visual_slam_frames"].seconds_per["pixels"] = 1e-6;
  ASSERT_TRUE(equip_to_see(scenario, ModeledPlatform{model}, World{}, equipment).ok());
  ASSERT_NE(equipment.eye, nullptr);
  EXPECT_EQ(equipment.eye->spec().width_px, scenario.camera.width_px);
}

class Photographer : public testing::Test {
 protected:
  Photographer() {
    scenario.mission.workload = "aerial_photography";
    scenario.platform.name = "mine";
    model.kernels["hog"].seconds_per["images"] = 0.1;
  }
  Status equip() {
    const ModeledPlatform platform{model};
    return equip_to_see(scenario, platform, world, equipment);
  }
  Scenario scenario;
  PlatformModel model{kit::free_of_charge()};
  World world;
  MissionEquipment equipment;
};

TEST_F(Photographer, gets_camera_detector_and_two_trackers) {
  ASSERT_TRUE(equip().ok());
  EXPECT_NE(equipment.colour_camera, nullptr);
  EXPECT_NE(equipment.kernels.detector, nullptr);
  EXPECT_NE(equipment.kernels.buffered_tracker, nullptr);
  EXPECT_NE(equipment.kernels.real_time_tracker, nullptr);
}

TEST_F(Photographer, does_not_look_for_free) {
  scenario.kernels.detector = "haar";
  const Status status = equip();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("\"haar\""), std::string::npos);
  scenario.detector.cost_of = "hog";
  EXPECT_TRUE(equip().ok());
}

TEST_F(Photographer, is_told_which_package_has_the_people) {
  world.people.resize(1);
  scenario.colour_camera.people_folder = "/nowhere";
  const Status status = equip();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("morse-simulator-data"), std::string::npos);
}

TEST_F(Photographer, is_told_of_a_tracker_that_does_not_exist) {
  scenario.kernels.tracker = "eagle";
  const Status status = equip();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("\"eagle\""), std::string::npos);
}

}  // namespace
}  // namespace flyball
