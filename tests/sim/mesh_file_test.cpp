// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/worlds.h"

#include "made_world.h"
#include "scratch_folder.h"
#include <fstream>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// A wall across x = 5, from y = -4 to 4 and 3 m high, on a floor of 12 x 8 m.
constexpr const char* hall_obj =
    "v -1 -4 0\nv 11 -4 0\nv 11 4 0\nv -1 4 0\nf 1 2 3 4\n"
    "v 5.05 -4 0\nv 5.05 4 0\nv 5.05 4 3\nv 5.05 -4 3\nf 5 6 7 8\n";

class MeshFile : public testing::Test {
 protected:
  MeshFile() { std::ofstream{path} << hall_obj; }
  const ScratchFolder scratch;
  const std::string path = scratch.path("hall.obj");
};

TEST_F(MeshFile, is_solid_where_its_surfaces_are_and_free_elsewhere) {
  const auto world = made_world("mesh_file", 1, {{"file", path}, {"cell_m", 0.1}});
  ASSERT_TRUE(world) << world.error().message;
  const Clearance clearance{*world};
  const Cylinder body{0.3, 0.2};
  EXPECT_NEAR(clearance.distance_m({3.0, 0.0, 1.5}, body, 10.0, true), 1.7, 0.051);
  EXPECT_NEAR(clearance.distance_m({7.0, 1.0, 1.5}, body, 10.0, true), 1.6, 0.051);
  // The file's floor is the ground, not a layer of cells upon it.
  EXPECT_NEAR(clearance.distance_m({0.0, 0.0, 0.21}, body, 10.0, true), 4.7, 0.051);
  EXPECT_EQ(world->goal_W, (Vec3{10.0, 0.0, 0.0}));
  EXPECT_DOUBLE_EQ(world->zones.front().max_speed_m_s, 1.0);
}

TEST_F(MeshFile, says_how_clear_start_and_goal_are) {
  const auto world = made_world("mesh_file", 1, {{"file", path}, {"goal_x_m", 4.35}});
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_DOUBLE_EQ(world->start_clear_m, 1.0) << "the wall is 5 m away";
  // The wall's cells begin at x = 5.0.
  EXPECT_GE(world->goal_clear_m, 0.55);
  EXPECT_LE(world->goal_clear_m, 0.65);
}

TEST_F(MeshFile, is_asked_for_a_file) {
  const auto world = made_world("mesh_file", 1);
  ASSERT_FALSE(world);
  EXPECT_NE(world.error().message.find("set world.file"), std::string::npos);
}

TEST_F(MeshFile, of_the_wrong_unit_reaches_too_far_for_a_world) {
  const auto world =
      made_world("mesh_file", 1, {{"file", path}, {"cell_m", 1.0}, {"metres_per_unit", 1200.0}});
  ASSERT_FALSE(world);
  EXPECT_NE(world.error().message.find("metres_per_unit"), std::string::npos)
      << world.error().message;
}

TEST_F(MeshFile, refuses_a_start_that_is_not_in_it) {
  const auto world = made_world("mesh_file", 1, {{"file", path}, {"start_x_m", -40.0}});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().code, ErrorCode::invalid_input);
  EXPECT_NE(world.error().message.find("start (-40.00, 0.00) m lies outside"), std::string::npos)
      << world.error().message;
}

TEST_F(MeshFile, refuses_a_goal_inside_of_a_solid) {
  const auto world = made_world("mesh_file", 1, {{"file", path}, {"goal_x_m", 5.2}});
  ASSERT_FALSE(world);
  EXPECT_NE(world.error().message.find("goal (5.20, 0.00) m has no room"), std::string::npos)
      << world.error().message;
}

}  // namespace
}  // namespace flyball
