// SPDX-License-Identifier: BSD-3-Clause
#include "planning/plan_sampler.h"

#include "plan_scenes.h"
#include <cmath>

#include <gtest/gtest.h>

namespace {

using flyball::MotionChecker;
using flyball::PlanSampler;
using flyball::Vec3;

struct Office {
  flyball::kit::Scene scene = flyball::kit::office(0, 4);
  MotionChecker checker{scene.map, scene.request.body, 0.35};
  flyball::SampleRegion region{
      {{0.5, -14.5, 0.6}, {44.5, 14.5, 2.6}}, scene.request.start_W, scene.request.goal_W};

  /// Where the body is just out of the first wall, and flies straight through its door.
  bool is_beside_first_door(const Vec3& p) {
    const double side_m = p.x() - 10.125;
    return std::abs(std::abs(side_m) - 0.455) < 0.03 &&
           checker.is_flyable(p, p - Vec3{2.0 * side_m, 0, 0});
  }
};

TEST(PlanSampler, stays_in_its_box_and_mostly_at_the_height_of_the_ends) {
  Office office;
  PlanSampler sampler{office.checker, office.region, 1};
  int level = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = sampler.draw();
    ASSERT_TRUE(office.region.box_W.contains(p)) << p.transpose();
    level += std::abs(p.z() - 1.5) < 0.5 ? 1 : 0;
  }
  EXPECT_GT(level, 1400);
  EXPECT_LT(level, 2000);
  EXPECT_EQ(sampler.draws(), 2000);
}

TEST(PlanSampler, draws_the_same_from_the_same_seed_only) {
  Office office;
  PlanSampler one{office.checker, office.region, 1};
  PlanSampler same{office.checker, office.region, 1};
  PlanSampler other{office.checker, office.region, 2};
  int equal = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = one.draw();
    EXPECT_EQ(p, same.draw());
    equal += p == other.draw() ? 1 : 0;
  }
  EXPECT_LT(equal, 60);  // the sides of a door are few places
}

TEST(PlanSampler, looks_for_passages_only_when_the_plan_is_not_easy) {
  Office office;
  PlanSampler sampler{office.checker, office.region, 1};
  const auto count_beside_door = [&](int draws) {
    int hits = 0;
    for (int i = 0; i < draws; ++i) {
      hits += office.is_beside_first_door(sampler.draw()) ? 1 : 0;
    }
    return hits;
  };
  const double before = office.checker.queries();
  for (int i = 0; i < 40; ++i) {
    (void)sampler.draw();
  }
  EXPECT_EQ(office.checker.queries(), before);
  EXPECT_GT(count_beside_door(500), 20);
}

/// Of 500 samples between ends at this height, those beside the first door, which is 2.1 m high.
int hits_beside_door(Office office, double ends_z_m) {
  office.region.start_W.z() = office.region.goal_W.z() = ends_z_m;
  MotionChecker checker{office.scene.map, office.scene.request.body, 0.35};
  PlanSampler sampler{checker, office.region, 1};
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    hits += office.is_beside_first_door(sampler.draw()) ? 1 : 0;
  }
  return hits;
}

TEST(PlanSampler, looks_below_lintels_from_right_under_a_ceiling) {
  Office office;
  EXPECT_GT(hits_beside_door(office, 1.5), 20);
  EXPECT_EQ(hits_beside_door(office, 2.3), 0) << "nothing is above it";
  office.scene.map.fill({{0, -15, 2.85}, {45, 15, 3}}, flyball::CellState::occupied);
  EXPECT_GT(hits_beside_door(office, 2.3), 20);
}

TEST(PlanSampler, draws_where_short_paths_can_be_and_from_passages_at_once) {
  Office office;
  const Vec3 line = office.region.goal_W - office.region.start_W;
  office.region.shorter_than_m = 1.3 * line.norm();
  PlanSampler sampler{office.checker, office.region, 1};
  int outside = 0;
  int in_door = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 p = sampler.draw();
    const double over_m = (p - office.region.start_W).norm() + (office.region.goal_W - p).norm();
    outside += over_m >= office.region.shorter_than_m ? 1 : 0;
    in_door += i < 48 && office.is_beside_first_door(p) ? 1 : 0;
  }
  EXPECT_LT(outside, 4);
  EXPECT_GT(in_door, 0);
}

}  // namespace
