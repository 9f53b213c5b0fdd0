// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/seeing_setup.h"

#include "flyball/scenario/plugins.h"

#include "grid_map.h"
#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(SeeingSetup, gives_a_workload_that_looks_for_nobody_no_camera) {
  const Scenario scenario;
  const ModeledPlatform platform{kit::free_of_charge()};
  MissionEquipment equipment;
  const auto cameras = equip_to_see(scenario, platform, World{}, equipment);
  ASSERT_TRUE(cameras.ok());
  EXPECT_EQ(cameras->gimbal, nullptr);
  EXPECT_EQ(equipment.kernels.detector, nullptr);
}

TEST(SeeingSetup, gives_a_localizer_that_takes_images_a_camera_when_it_has_a_price) {
  Scenario scenario;
  scenario.kernels.localizer = "visual_slam";
  PlatformModel model{kit::free_of_charge()};
  MissionEquipment equipment;
  equipment.kernels.localizer = Plugins{}.make<Localizer>("visual_slam");
  const auto unpriced = equip_to_see(scenario, ModeledPlatform{model}, World{}, equipment);
  ASSERT_FALSE(unpriced.ok());
  EXPECT_NE(unpriced.error().message.find("[kernels.visual_slam_frames]"), std::string::npos);
  EXPECT_FALSE(equipment.has_rgb_camera);
  model.kernels["visual_slam_frames"].seconds_per["pixels"] = 1e-6;
  const auto cameras = equip_to_see(scenario, ModeledPlatform{model}, World{}, equipment);
  ASSERT_TRUE(cameras.ok());
  EXPECT_TRUE(equipment.has_rgb_camera);
  ASSERT_NE(cameras->forward, nullptr);
  EXPECT_EQ(cameras->forward->spec().width_px, scenario.camera.width_px);
}

class Photographer : public testing::Test {
 protected:
  Photographer() {
    scenario.mission.workload = "aerial_photography";
    scenario.platform.name = "mine";
    model.kernels["hog"].seconds_per["images"] = 0.1;
    model.kernels["kcf_buffered"].seconds_per["pixels"] = 1e-7;
    model.kernels["kcf_real_time"].seconds_per["pixels"] = 1e-7;
  }
  Result<ColourCameras> equip() {
    const ModeledPlatform platform{model};
    return equip_to_see(scenario, platform, world, equipment);
  }
  Scenario scenario;
  PlatformModel model{kit::free_of_charge()};
  World world;
  MissionEquipment equipment;
};

TEST_F(Photographer, gets_camera_detector_and_two_trackers) {
  const auto cameras = equip();
  ASSERT_TRUE(cameras.ok());
  EXPECT_NE(cameras->gimbal, nullptr);
  EXPECT_NE(equipment.kernels.detector, nullptr);
  EXPECT_NE(equipment.kernels.buffered_tracker, nullptr);
  EXPECT_NE(equipment.kernels.real_time_tracker, nullptr);
}

TEST_F(Photographer, does_not_look_for_free) {
  scenario.kernels.detector = "haar";
  const auto status = equip();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("\"haar\""), std::string::npos);
  scenario.detector.cost_of = "hog";
  EXPECT_TRUE(equip().ok());
}

TEST_F(Photographer, does_not_track_for_free) {
  for (const std::string use : {"kcf_buffered", "kcf_real_time"}) {
    const KernelCost price = model.kernels.at(use);
    model.kernels.erase(use);
    const auto status = equip();
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("[kernels." + use + "]"), std::string::npos)
        << status.error().message;
    model.kernels[use] = price;
  }
}

TEST_F(Photographer, is_told_which_package_has_the_people) {
  world.people.resize(1);
  scenario.colour_camera.people_folder = "/nowhere";
  const auto status = equip();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("morse-simulator-data"), std::string::npos);
}

TEST_F(Photographer, is_told_of_a_tracker_that_does_not_exist) {
  scenario.kernels.tracker = "eagle";
  const auto status = equip();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("\"eagle\""), std::string::npos);
}

}  // namespace
}  // namespace flyball
