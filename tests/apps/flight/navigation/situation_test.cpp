// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/situation.h"

#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Situation, knows_what_a_path_takes_at_the_missions_speed_limits) {
  Site with_a_house;
  with_a_house.zones = {{{Vec3{10.0, -5.0, 0.0}, Vec3{20.0, 5.0, 5.0}}, 1.0}};
  const kit::GridMap map{{Vec3{-1.0, -1.0, 0.0}, Vec3{1.0, 1.0, 1.0}}, 0.5, CellState::free};
  kit::MissionRig rig{map, kit::MissionRig::one_core(), with_a_house};
  ASSERT_TRUE(rig.set("mission.max_speed_m_s", 5.0));
  const Situation situation = rig.situation();
  const Vec3 before_W{0.0, 0.0, 1.0};
  const Vec3 behind_W{30.0, 0.0, 1.0};
  EXPECT_NEAR(situation.least_s({before_W, behind_W}), 7.0 / 5.0 + 16.0 + 7.0 / 5.0, 1e-9);
  EXPECT_NEAR(situation.least_s({before_W, Vec3{10.0, 0.0, 1.0}, behind_W}), 18.8, 1e-9);
  EXPECT_EQ(situation.least_s({before_W}), 0.0);

  const std::vector<Vec3> around_W{before_W, Vec3{0.0, 9.0, 1.0}, Vec3{30.0, 9.0, 1.0}, behind_W};
  EXPECT_NEAR(situation.detour_s(around_W), 48.0 / 5.0 - 18.8, 1e-9) << "18 m more, but sooner";
  const std::vector<Vec3> beside_W{before_W, Vec3{0.0, 6.0, 1.0}, Vec3{30.0, 6.0, 1.0}, behind_W};
  EXPECT_NEAR(situation.least_s(beside_W), (6.0 + 7.0 + 7.0 + 6.0) / 5.0 + 16.0, 1e-9)
      << "1 m beside the house it is as slow as inside";
  EXPECT_NEAR(situation.detour_s({before_W, behind_W}), 0.0, 1e-9);
  EXPECT_EQ(situation.detour_s({}), 0.0);
}

TEST(Situation, tells_the_zones_in_which_the_vehicle_is_slow) {
  Site site;
  const Aabb house_W{Vec3{10.0, -5.0, 0.0}, Vec3{20.0, 5.0, 5.0}};
  const Aabb park_W{Vec3{30.0, -5.0, 0.0}, Vec3{40.0, 5.0, 5.0}};
  site.zones = {{house_W, slow_m_s}, {park_W, 2.0 * slow_m_s}};
  const kit::GridMap map{{Vec3{-1.0, -1.0, 0.0}, Vec3{1.0, 1.0, 1.0}}, 0.5, CellState::free};
  const kit::MissionRig rig{map, kit::MissionRig::one_core(), site};
  const std::vector<Aabb> slow_W = rig.situation().slow_zones_W();
  ASSERT_EQ(slow_W.size(), 1U);
  EXPECT_EQ(slow_W.front().min, house_W.min);
  EXPECT_EQ(slow_W.front().max, house_W.max);
}

}  // namespace
}  // namespace flyball
