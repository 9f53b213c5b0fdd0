// SPDX-License-Identifier: BSD-3-Clause
#include "world/congestion.h"

#include "floor_plan.h"
#include "made_world.h"
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double body_and_tube_m = 0.355;  // Half of .65 m, and .03 m.

CongestionPlan crowd_at_origin() {
  CongestionPlan plan;
  plan.peaks_W = {Vec3::Zero()};
  plan.density = 0.5;
  plan.spread_m = 200.0;
  plan.area_W = {{-500.0, -500.0, 0.0}, {500.0, 500.0, 0.0}};
  return plan;
}

std::size_t blocks_between(const std::vector<Aabb>& blocks, double near_m, double far_m) {
  std::size_t count = 0;
  for (const Aabb& block : blocks) {
    const double d_m = (0.5 * (block.min + block.max)).head<2>().norm();
    count += d_m >= near_m && d_m < far_m ? 1U : 0U;
  }
  return count;
}

TEST(CongestedBlocks, stand_as_densely_as_the_profile_says) {
  RandomStream random{1, "congestion_test"};
  const CongestionPlan plan = crowd_at_origin();
  const std::vector<Aabb> blocks = congested_blocks(plan, random);
  // The integral of the profile over a ring, in grid points of 100 m2.
  const double sigma_m = 0.5 * plan.spread_m;
  const auto expected = [&](double near_m, double far_m) {
    const auto kept = [&](double d_m) { return std::exp(-0.5 * d_m * d_m / (sigma_m * sigma_m)); };
    return plan.density * 2.0 * M_PI * sigma_m * sigma_m * (kept(near_m) - kept(far_m)) / 100.0;
  };
  for (const auto& [near_m, far_m] : {std::pair{0.0, 100.0}, {100.0, 200.0}, {200.0, 300.0}}) {
    const double mean = expected(near_m, far_m);
    // Four standard deviations of a binomial count, which is below a Poisson's.
    EXPECT_NEAR(static_cast<double>(blocks_between(blocks, near_m, far_m)), mean,
                4.0 * std::sqrt(mean));
  }
}

TEST(CongestedBlocks, leave_streets_of_six_metres) {
  RandomStream random{2, "congestion_test"};
  CongestionPlan plan = crowd_at_origin();
  plan.density = 1.0;
  const std::vector<Aabb> blocks = congested_blocks(plan, random);
  ASSERT_GT(blocks.size(), 100U);
  for (const Aabb& a : blocks) {
    const Vec3 size = a.max - a.min;
    EXPECT_EQ(size, Vec3(4.0, 4.0, plan.height_m));
    for (const Aabb& b : blocks) {
      const Vec3 gap = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Vec3::Zero());
      EXPECT_TRUE(&a == &b || std::max(gap.x(), gap.y()) >= 6.0 - 1e-9);
    }
  }
}

TEST(CongestedBlocks, keep_out_of_clear_places_and_move_nothing_else) {
  CongestionPlan plan = crowd_at_origin();
  RandomStream first{3, "congestion_test"};
  const std::size_t all = congested_blocks(plan, first).size();
  plan.clear_W = {{40.0, 40.0, 0.0}};
  plan.clear_radius_m = 15.0;
  RandomStream second{3, "congestion_test"};
  const std::vector<Aabb> rest = congested_blocks(plan, second);
  EXPECT_LT(rest.size(), all);
  EXPECT_GE(rest.size() + 16U, all);
  for (const Aabb& block : rest) {
    const Vec3 nearest = plan.clear_W[0].cwiseMax(block.min).cwiseMin(block.max);
    EXPECT_GE((nearest - plan.clear_W[0]).head<2>().norm(), 15.0 - 1e-9);
  }
}

TEST(Congestion, meets_each_of_its_settings_once_in_27_seeds) {
  std::set<std::tuple<std::size_t, long>> seen;
  std::set<long> distances_m;
  for (std::uint64_t seed = 1; seed <= 27; ++seed) {
    const auto world = made_world("congestion", seed);
    ASSERT_TRUE(world) << world.error().message;
    const double goal_m = (world->goal_W - world->start_W).norm();
    distances_m.insert(std::lround(goal_m));
    seen.insert({world->boxes.size(), std::lround(goal_m)});
    const double bearing_deg = std::abs(yaw_of(world->goal_W)) * 180.0 / M_PI;
    EXPECT_GE(bearing_deg, 10.0);
    EXPECT_LE(bearing_deg, 35.0);
  }
  EXPECT_EQ(distances_m, (std::set<long>{600, 900, 1200}));
  EXPECT_GE(seen.size(), 25U);  // Two settings may happen to have as many blocks.
}

TEST(Congestion, lets_a_vehicle_with_cells_of_a_metre_and_a_fifth_through) {
  for (std::uint64_t seed = 1; seed <= 27; ++seed) {
    const auto world =
        made_world("congestion", seed, {{"goal_m", 300.0}, {"density", 0.6}, {"spread_m", 120.0}});
    ASSERT_TRUE(world) << world.error().message;
    const FloorPlan plan{*world, 1.2, 1.8, 2.3};
    EXPECT_TRUE(plan.connects(world->start_W, world->goal_W, body_and_tube_m)) << "seed " << seed;
    for (const Aabb& block : world->boxes) {
      EXPECT_GT(block.max.z(), world->bounds_W.max.z());  // Nothing is flown over.
    }
  }
}

}  // namespace
}  // namespace flyball
