// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/scenario_keys.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

const std::vector<std::string> known{"map.range_m", "map.rate_hz", "mission.max_speed_m_s",
                                     "platform.cores", "world.density_1_m2"};

TEST(ScenarioKeys, a_key_is_split_into_stem_and_unit) {
  EXPECT_EQ(parts_of("mission.max_speed_m_s").stem, "mission.max_speed");
  EXPECT_EQ(parts_of("mission.max_speed_m_s").unit, "m/s");
  EXPECT_EQ(parts_of("mission.max_acceleration_m_s2").unit, "m/s^2");
  EXPECT_EQ(parts_of("platform.cores").unit, "");
  EXPECT_EQ(parts_of("_m").stem, "_m") << "a unit alone is a name";
}

TEST(ScenarioKeys, a_wrong_or_missing_unit_is_recognised) {
  for (const char* wrong : {"map.range_cm", "map.range", "map.range_km", "map.range_meters"}) {
    EXPECT_EQ(suggest_key(wrong, known), "did you mean map.range_m, in m?") << wrong;
  }
  EXPECT_EQ(suggest_key("platform.cores_hz", known),
            "did you mean platform.cores, without a unit?");
  EXPECT_EQ(suggest_key("mission.max_speed_km_h", known),
            "did you mean mission.max_speed_m_s, in m/s?");
}

TEST(ScenarioKeys, a_slip_of_the_pen_or_section_finds_its_key) {
  EXPECT_EQ(suggest_key("map.rnage_m", known), "did you mean map.range_m?");
  EXPECT_EQ(suggest_key("range_m", known), "did you mean map.range_m?");
  EXPECT_EQ(suggest_key("camera.rate_hz", known), "did you mean map.rate_hz?");
  EXPECT_EQ(suggest_key("world.densit", known), "did you mean world.density_1_m2?");
}

TEST(ScenarioKeys, the_nearest_key_of_its_section_is_meant) {
  const std::vector<std::string> keys{"scan.length_m",   "scan.height_m",
                                      "search.height_m", "kernels.planner_parameters.range_m",
                                      "camera.rate_hz",  "detector.rate_hz"};
  EXPECT_EQ(suggest_key("scan.heigth_m", keys), "did you mean scan.height_m?");
  EXPECT_EQ(suggest_key("search.heigth_m", keys), "did you mean search.height_m?");
  EXPECT_EQ(suggest_key("detecter.rate_hz", keys), "did you mean detector.rate_hz?");
  EXPECT_EQ(suggest_key("kernels.mapper_parameters.finest_m", keys), "");
}

TEST(ScenarioKeys, nothing_is_suggested_for_what_is_like_nothing) {
  EXPECT_EQ(suggest_key("weather", known), "");
  EXPECT_EQ(nearest_name("xyz", {"octomap", "flyball"}), "");
}

}  // namespace
}  // namespace flyball
