// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/worlds.h"

#include "floor_plan.h"
#include "made_world.h"
#include "scratch_folder.h"
#include <filesystem>

#include <gtest/gtest.h>
#include <octomap/octomap.h>

namespace flyball {
namespace {

constexpr double body_and_tube_m = 0.355;  // Half of .65 m, and .03 m.

std::vector<Vec3> corners(const World& world) {
  std::vector<Vec3> all;
  for (const Aabb& box : world.boxes) {
    all.push_back(box.min);
    all.push_back(box.max);
  }
  for (const Pillar& pillar : world.pillars) {
    all.push_back(pillar.foot_W);
  }
  return all;
}

// Whether nothing stands in the cylinder above a place, to 2.5 m, where the vehicle takes off or
// lands.
bool is_clear(const World& world, const Vec3& place, double radius_m) {
  const Clearance clearance{world};
  return clearance.distance_m(place + Vec3{0.0, 0.0, 1.25}, {radius_m, 1.25}, 10.0, true) > 0.0;
}

class SeededWorlds : public testing::TestWithParam<const char*> {};

TEST_P(SeededWorlds, are_the_same_for_the_same_seed_and_differ_for_another) {
  const auto first = made_world(GetParam(), 1);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_EQ(corners(*first), corners(*made_world(GetParam(), 1)));
  EXPECT_NE(corners(*first), corners(*made_world(GetParam(), 2)));
}

TEST_P(SeededWorlds, leave_room_to_take_off_and_land) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto world = made_world(GetParam(), seed);
    ASSERT_TRUE(world) << world.error().message;
    for (const Vec3& place : {world->start_W, world->goal_W}) {
      EXPECT_TRUE(is_clear(*world, place, 1.0)) << "seed " << seed;
      EXPECT_TRUE(world->bounds_W.contains(place + Vec3{0.0, 0.0, world->cruise_height_m}));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All,
    SeededWorlds,
    testing::Values(
        "city_blocks", "farm", "forest", "outdoor_to_indoor", "congestion", "mixed", "office"));

TEST(Empty, has_a_goal_at_the_distance_that_was_asked_for) {
  const auto world = made_world("empty", 1, {{"goal_distance_m", 70.0}});
  ASSERT_TRUE(world);
  EXPECT_EQ((world->goal_W - world->start_W).norm(), 70.0);
  EXPECT_TRUE(world->boxes.empty() && world->pillars.empty());
}

TEST(Forest, has_the_density_asked_for_and_keeps_its_gaps) {
  const auto world = made_world("forest", 3, {{"density_1_m2", 0.03}, {"min_gap_m", 2.5}});
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_EQ(world->pillars.size(), 204U);  // .03 / m2 on (150 + 2 * 10) m x 40 m.
  for (const Pillar& a : world->pillars) {
    for (const Pillar& b : world->pillars) {
      const double apart_m = (a.foot_W - b.foot_W).norm();
      EXPECT_TRUE(&a == &b || apart_m - a.radius_m - b.radius_m >= 2.5);
    }
  }
}

TEST(Forest, says_so_when_the_trunks_do_not_fit) {
  const auto world = made_world("forest", 3, {{"density_1_m2", 0.08}, {"min_gap_m", 10.0}});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().code, ErrorCode::invalid_input);
  EXPECT_NE(world.error().message.find("min_gap_m"), std::string::npos);
}

TEST(Forest, has_walkers_who_meet_no_trunk_and_leaves_its_trunks_as_they_were) {
  const auto empty = made_world("forest", 4);
  const auto world = made_world("forest", 4, {{"walkers", 5.0}});
  ASSERT_TRUE(world) << world.error().message;
  ASSERT_EQ(world->movers.size(), 5U);
  EXPECT_EQ(corners(*empty), corners(*world));
  const Clearance clearance{*world};
  for (const Mover& walker : world->movers) {
    for (int t_s = 0; t_s < 40; ++t_s) {
      const Aabb box = box_at(walker, MissionTime{std::chrono::seconds{t_s}});
      const Vec3 middle = 0.5 * (box.min + box.max);
      EXPECT_GT(clearance.distance_m(middle, {0.36, 0.8}, 1.0, true), 0.0);
    }
  }
}

TEST(Farm, has_nothing_above_the_height_that_it_names_and_a_yard_that_is_open_to_the_sky) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto world = made_world("farm", seed, {{"trees", 200.0}, {"tree_height_m", 12.0}});
    ASSERT_TRUE(world) << world.error().message;
    ASSERT_TRUE(world->open_above_m);
    for (const Vec3& corner : corners(*world)) {
      EXPECT_LE(corner.z(), *world->open_above_m);
    }
    for (const Pillar& trunk : world->pillars) {
      EXPECT_LE(trunk.foot_W.z() + trunk.height_m, *world->open_above_m);
    }
    const Clearance clearance{*world};
    EXPECT_GE(clearance.distance_m(world->start_W + Vec3{0.0, 0.0, 10.0}, {1.0, 10.0}, 10.0, true),
              4.0);
  }
}

TEST(Farm, has_its_fields_in_the_middle_and_a_gate_in_each_fence) {
  const auto world = made_world(
      "farm", 1, {{"length_m", 80.0}, {"width_m", 60.0}, {"fields", 3.0}, {"trees", 0.0}});
  ASSERT_TRUE(world) << world.error().message;
  const Vec3 centre = 0.5 * (world->bounds_W.min + world->bounds_W.max);
  EXPECT_TRUE(centre.head<2>().isApprox(Eigen::Vector2d{40.0, 30.0}));
  for (const double fence_y_m : {20.0, 40.0}) {
    double fence_m = 0.0;
    for (const Aabb& box : world->boxes) {
      fence_m +=
          box.min.y() < fence_y_m && box.max.y() > fence_y_m ? box.max.x() - box.min.x() : 0.0;
    }
    EXPECT_NEAR(fence_m, 76.0, 1e-9) << fence_y_m;  // 80 m less a gate of 4.
  }
}

TEST(OctomapFile, says_what_is_wrong_with_a_file) {
  const auto missing = made_world("octomap_file", 1, {{"file", "no_such_map.bt"}, {"pair", 0.0}});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  const auto contradiction = made_world("octomap_file", 1, {{"file", "other.bt"}, {"pair", 2.0}});
  ASSERT_FALSE(contradiction);
  EXPECT_EQ(contradiction.error().code, ErrorCode::invalid_input);
}

TEST(OctomapFile, names_the_package_only_where_it_would_help) {
  const ScratchFolder scratch;
  const std::string damaged = scratch.file("place.bt", "# Octomap OcTree binary file\n");
  for (const std::string& file : {std::string{"no_such_map.bt"}, damaged}) {
    const auto world = made_world("octomap_file", 1, {{"file", file}, {"pair", 0.0}});
    ASSERT_FALSE(world);
    EXPECT_EQ(world.error().message.find("liboctomap-dev"), std::string::npos)
        << world.error().message;
  }
}

TEST(OctomapFile, takes_a_bare_name_from_the_current_folder_first) {
  const ScratchFolder scratch;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(scratch.path());
  octomap::OcTree tree{0.1};
  for (int x = -5; x < 20; ++x) {
    for (int y = -20; y < 20; ++y) {
      tree.updateNode(x + 0.05, 0.1 * y + 0.05, 1.25, false);
    }
  }
  tree.updateNode(5.05, 0.05, 1.25, true);
  EXPECT_TRUE(tree.write("geb079.bt"));  // Log-odds: .ot serves as well, whatever its name.
  const auto world = made_world("octomap_file", 1, {{"pair", 0.0}, {"goal_x_m", 9.0}});
  std::filesystem::current_path(before);
  ASSERT_TRUE(world) << world.error().message;
  ASSERT_EQ(world->boxes.size(), 1U);
  EXPECT_NEAR(world->boxes[0].min.x(), 5.0, 1e-9);
}

TEST(OctomapFile, ships_pairs_that_the_vehicle_can_fly_between) {
  for (int pair = 1; pair <= 5; ++pair) {
    const auto world = made_world("octomap_file", 1, {{"pair", static_cast<double>(pair)}});
    if (!world) {
      ASSERT_EQ(world.error().code, ErrorCode::not_found) << world.error().message;
      GTEST_SKIP() << "liboctomap-dev's example geb079.bt is not installed";
    }
    const double z_m = world->ground_z_m + world->cruise_height_m;
    const FloorPlan plan{*world, 0.15, z_m - 0.2, z_m + 0.2};
    EXPECT_TRUE(plan.connects(world->start_W, world->goal_W, body_and_tube_m)) << "pair " << pair;
    // The office has no wider place than .787 m.
    EXPECT_TRUE(is_clear(*world, world->start_W, 0.78)) << "pair " << pair;
    EXPECT_TRUE(is_clear(*world, world->goal_W, 0.78)) << "pair " << pair;
  }
}

TEST(Farm, has_no_crop_where_a_field_is_all_path) {
  const auto world = made_world("farm", 1, {{"width_m", 20.0}, {"fields", 20.0}});
  ASSERT_TRUE(world) << world.error().message;
  for (const Aabb& box : world->boxes) {
    EXPECT_GT((box.max - box.min).minCoeff(), 0.0);
  }
}

TEST(CityBlocks, refuses_lorries_without_a_street_for_them) {
  const auto world = made_world("city_blocks", 1, {{"lorries", 3.0}, {"columns", 1.0}});
  ASSERT_FALSE(world);
  EXPECT_NE(world.error().message.find("set columns to 2"), std::string::npos);
  EXPECT_TRUE(made_world("city_blocks", 1, {{"lorries", 3.0}, {"columns", 2.0}}));
}

}  // namespace
}  // namespace flyball
