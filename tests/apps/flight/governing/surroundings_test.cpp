// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/governing/surroundings.h"

#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// A house and, around it, a garden, 10 m ahead of the origin.
Site with_a_house() {
  Site site;
  site.zones = {{{Vec3{10.0, -5.0, 0.0}, Vec3{30.0, 5.0, 5.0}}, 5.0},
                {{Vec3{15.0, -2.0, 0.0}, Vec3{25.0, 2.0, 5.0}}, 1.0}};
  return site;
}

double zone_from_m(const Vec3& p_W, const Site& site) {
  const kit::GridMap map{{Vec3{-1.0, -1.0, 0.0}, Vec3{1.0, 1.0, 1.0}}, 0.5, CellState::free};
  const kit::MissionRig rig{map, kit::MissionRig::one_core(), site};
  NavigatorState navigator;
  navigator.position_W = p_W;
  return slower_zone_m(navigator, *rig.knobs, site);
}

TEST(Surroundings, know_how_far_the_nearest_slower_zone_is) {
  EXPECT_DOUBLE_EQ(zone_from_m({0.0, 0.0, 1.0}, with_a_house()), 10.0);
  EXPECT_DOUBLE_EQ(zone_from_m({7.0, 9.0, 1.0}, with_a_house()), 5.0) << "3 and 4 m to a corner";
  EXPECT_DOUBLE_EQ(zone_from_m({12.0, 0.0, 1.0}, with_a_house()), 3.0) << "from the garden";
  EXPECT_DOUBLE_EQ(zone_from_m({20.0, 0.0, 1.0}, with_a_house()), 40.0) << "the garden is faster";
  EXPECT_DOUBLE_EQ(zone_from_m({-90.0, 0.0, 1.0}, with_a_house()), 40.0);
  EXPECT_DOUBLE_EQ(zone_from_m(Vec3::Zero(), {}), 40.0);
}

}  // namespace
}  // namespace flyball
