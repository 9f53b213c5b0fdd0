// SPDX-License-Identifier: BSD-3-Clause
#include "visual/overlap.h"

#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

const Aabb unit{{0, 0, 0}, {1, 1, 1}};

TEST(Overlap, does_not_count_touching) {
  const Cylinder body{0.5, 0.25};
  EXPECT_FALSE(BodyShape(Vec3{1.5, 0.5, 0.5}, body).overlaps(unit));
  EXPECT_TRUE(BodyShape(Vec3{1.5 - 1e-6, 0.5, 0.5}, body).overlaps(unit));
  EXPECT_FALSE(BodyShape(Vec3{0.5, 0.5, 1.25}, body).overlaps(unit));
  EXPECT_TRUE(BodyShape(Vec3{0.5, 0.5, 1.25 - 1e-6}, body).overlaps(unit));
  EXPECT_FALSE(BoxShape({{1, 0, 0}, {2, 1, 1}}).overlaps(unit));
}

TEST(Overlap, rounds_the_corners_of_a_disc) {
  const double reach_m = 0.5 / std::sqrt(2.0);
  EXPECT_FALSE(BodyShape(Vec3{1 + reach_m, 1 + reach_m, 0.5}, Cylinder{0.5, 0.1}).overlaps(unit));
  EXPECT_TRUE(
      BodyShape(Vec3{1 + reach_m - 1e-6, 1 + reach_m, 0.5}, Cylinder{0.5, 0.1}).overlaps(unit));
}

TEST(Overlap, treats_a_sweep_that_stands_still_as_the_body) {
  std::mt19937 generator{1};
  std::uniform_real_distribution<double> coordinate{-1.0, 2.0};
  int overlaps = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = coordinate(generator);
    const double y = coordinate(generator);
    const Vec3 p{x, y, coordinate(generator)};
    const Cylinder body{0.4, 0.2};
    const bool at_rest = BodyShape{p, body}.overlaps(unit);
    ASSERT_EQ(SweepShape(p, p, body).overlaps(unit), at_rest) << p.transpose();
    overlaps += at_rest ? 1 : 0;
  }
  EXPECT_GT(overlaps, 100);
}

TEST(Overlap, meets_a_box_only_while_the_sweep_is_at_its_height) {
  const Cylinder body{0.1, 0.1};
  // Climbs from far left below to far right above: over the box when it is at the box's height.
  EXPECT_TRUE(SweepShape(Vec3{-4.5, 0.5, -4.5}, Vec3{5.5, 0.5, 5.5}, body).overlaps(unit));
  // Passes above the box in the plane, but is at its height only before it gets there.
  EXPECT_FALSE(SweepShape(Vec3{-4.5, 0.5, 0.0}, Vec3{5.5, 0.5, 10.0}, body).overlaps(unit));
  // Goes straight up beside and through it.
  EXPECT_FALSE(SweepShape(Vec3{1.2, 0.5, -3.0}, Vec3{1.2, 0.5, 3.0}, body).overlaps(unit));
  EXPECT_TRUE(SweepShape(Vec3{1.05, 0.5, -3.0}, Vec3{1.05, 0.5, 3.0}, body).overlaps(unit));
}

TEST(Overlap, sees_a_small_box_beside_the_middle_of_a_long_segment) {
  const Cylinder body{0.3, 0.2};
  const Vec3 from{-100, -100, 0.5};
  const Vec3 to{100, 100, 0.5};
  const double side_m = 0.3 / std::sqrt(2.0);  // of the point on the sweep's edge, in x and y
  const auto box_at = [&](double offset_m) {
    return Aabb{{offset_m, -offset_m - 0.1, 0.4}, {offset_m + 0.1, -offset_m, 0.6}};
  };
  EXPECT_TRUE(SweepShape(from, to, body).overlaps(box_at(side_m - 1e-6)));
  EXPECT_FALSE(SweepShape(from, to, body).overlaps(box_at(side_m + 1e-6)));
}

TEST(Overlap, shrinks_the_nearest_shape_to_what_it_was_shown) {
  NearestShape shape{{-2.0, 0.5, 0.5}, 10.0, 1.0};
  EXPECT_TRUE(shape.overlaps(unit));
  shape.shrink_to(unit);
  EXPECT_DOUBLE_EQ(shape.nearest_m(), 2.0);
  EXPECT_FALSE(shape.overlaps({{0.5, 0, 0}, {1, 1, 1}}));
  EXPECT_FALSE(shape.overlaps({{-2.5, 0, 1.6}, {-1.5, 1, 2.0}}));  // outside the band
}

}  // namespace
}  // namespace flyball
