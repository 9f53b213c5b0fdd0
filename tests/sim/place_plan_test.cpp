// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/place_plan.h"

#include "scratch_folder.h"
#include <cmath>

#include <gtest/gtest.h>
#include <octomap/octomap.h>

namespace flyball {
namespace {

TEST(PlacePlan, of_a_mesh_shows_a_wall_at_the_heights_that_it_has) {
  const ScratchFolder scratch;
  const std::string file = scratch.file("hall.obj",
                                        "v -1 -4 0\nv 11 -4 0\nv 11 4 0\nv -1 4 0\nf 1 2 3 4\n"
                                        "v 5.05 -2 0\nv 5.05 2 0\nv 5.05 2 3\nv 5.05 -2 3\n"
                                        "f 5 6 7 8\n");
  const auto plan = plan_of_place(file, {});
  ASSERT_TRUE(plan) << plan.error().message;
  int occupied = 0;
  for (int row = 0; row < plan->rows; ++row) {
    for (int column = 0; column < plan->columns; ++column) {
      if (plan->at(column, row) == CellState::occupied) {
        ++occupied;
        EXPECT_NEAR(plan->x_m(column), 5.05, 0.051);
        EXPECT_LT(std::abs(plan->y_m(row)), 2.11);
      }
    }
  }
  EXPECT_EQ(plan->at(0, 0), CellState::free);
  EXPECT_NEAR(occupied, 41, 1) << "four metres of wall, not the floor";
  EXPECT_NEAR(plan->extent_W.min.x(), -1.0, 0.101);
  PlaceView above;
  above.height_m = 3.6;
  const auto nothing = plan_of_place(file, above);
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message.find("--height"), std::string::npos);
}

TEST(PlacePlan, of_a_map_keeps_free_and_unknown_apart) {
  const ScratchFolder scratch;
  octomap::OcTree tree{0.1};
  tree.updateNode(0.05, 0.05, 1.25, true);
  tree.updateNode(0.05, 0.05, 1.35, false);
  tree.updateNode(0.15, 0.05, 1.25, false);
  tree.updateNode(0.35, 0.05, 0.05, true);  // Below.
  ASSERT_TRUE(tree.write(scratch.path("place.ot")));
  const auto plan = plan_of_place(scratch.path("place.ot"), {});
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_EQ(plan->columns, 4);
  ASSERT_EQ(plan->rows, 1);
  EXPECT_EQ(plan->at(0, 0), CellState::occupied);
  EXPECT_EQ(plan->at(1, 0), CellState::free);
  EXPECT_EQ(plan->at(3, 0), CellState::unknown);
  EXPECT_NEAR(plan->x_m(3), 0.35, 1e-9);
}

TEST(PlacePlan, of_a_file_that_is_not_there_is_refused) {
  EXPECT_EQ(plan_of_place("/nowhere/hall.obj", {}).error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace flyball
