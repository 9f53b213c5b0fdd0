// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/counted_map.h"

#include "flyball/kernels/conformance/dense_map.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Free, with a wall at x = 3 m.
DenseMap walled() {
  DenseMap map{{Vec3::Zero(), Vec3::Constant(4.0)}, 0.5};
  map.fill({Vec3{3.0, 0.0, 0.0}, Vec3{3.5, 4.0, 4.0}}, CellState::occupied);
  return map;
}

TEST(CountedMap, answers_as_the_map_does) {
  const DenseMap map = walled();
  const CountedMap counted{map};
  const Cylinder body{0.3, 0.2};
  const Vec3 free_W{1.0, 2.0, 2.0};
  const Vec3 solid_W{3.2, 2.0, 2.0};
  EXPECT_EQ(counted.resolution_m(), 0.5);
  EXPECT_EQ(counted.state(solid_W), CellState::occupied);
  EXPECT_EQ(counted.body_state(free_W, body), CellState::free);
  EXPECT_TRUE(counted.has_occupied({free_W, Vec3{3.2, 2.4, 2.4}}));
  EXPECT_TRUE(counted.segment_hits(free_W, solid_W, body));
  EXPECT_EQ(counted.obstacle_density(solid_W, 1.0, 0.3), map.obstacle_density(solid_W, 1.0, 0.3));
  EXPECT_EQ(counted.nearest_obstacle_m(free_W, 3.0, 0.3), 2.0);
}

TEST(CountedMap, counts_each_kind_of_question_and_adds_none_that_nobody_asked) {
  const DenseMap map = walled();
  const CountedMap counted{map};
  const Cylinder body{0.3, 0.2};
  const Vec3 p_W{1.0, 2.0, 2.0};
  (void)counted.body_state(p_W, body);
  (void)counted.has_occupied({p_W, p_W});
  (void)counted.segment_hits(p_W, p_W, body);
  for (int i = 0; i < 3; ++i) {
    (void)counted.nearest_obstacle_m(p_W, 3.0, 0.3);
    (void)counted.state(p_W);
  }
  Work work;
  work.add("poses", 10.0);
  counted.add_to(work);
  EXPECT_EQ(work.count("poses"), 11.0);
  EXPECT_EQ(work.count("collision_queries"), 2.0);
  EXPECT_EQ(work.count("distances"), 3.0);
  EXPECT_EQ(work.count("cells"), 3.0);
  EXPECT_EQ(work.items().size(), 4U);  // Nobody asked for a density.
}

}  // namespace
}  // namespace flyball
