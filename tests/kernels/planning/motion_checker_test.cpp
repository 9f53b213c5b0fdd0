// SPDX-License-Identifier: BSD-3-Clause
#include "planning/motion_checker.h"

#include "bricks/brick_map.h"
#include "bricks/brick_view.h"
#include "plan_scenes.h"
#include <random>

#include <gtest/gtest.h>

namespace {

using flyball::Aabb;
using flyball::CellState;
using flyball::Cylinder;
using flyball::MotionChecker;
using flyball::Vec3;
using flyball::kit::GridMap;

GridMap wall_at_5_m() {
  GridMap map{{{0, -3, 0}, {10, 3, 6}}, 0.15};
  map.fill({{4.95, -3, 0}, {5.1, 3, 3}}, CellState::occupied);
  return map;
}

TEST(MotionChecker, refuses_steep_pieces_unless_they_are_short) {
  const GridMap map = wall_at_5_m();
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  EXPECT_TRUE(checker.is_flyable({1, 0, 1}, {3, 0, 1.7}));   // 19 degrees
  EXPECT_FALSE(checker.is_flyable({1, 0, 1}, {3, 0, 1.8}));  // 22 degrees
  EXPECT_FALSE(checker.is_flyable({1, 0, 1.8}, {3, 0, 1.0}));
  EXPECT_FALSE(checker.is_flyable({1, 0, 1}, {1, 0, 1.31}));
  EXPECT_TRUE(checker.is_flyable({1, 0, 1}, {1, 0, 1.29}));
}

TEST(MotionChecker, crosses_unknown_but_not_occupied_space) {
  GridMap map = wall_at_5_m();
  map.fill({{6, -3, 0}, {10, 3, 6}}, CellState::unknown);
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  EXPECT_TRUE(checker.is_free({8, 0, 1}));
  EXPECT_TRUE(checker.is_flyable({6, 0, 1}, {9, 0, 1}));
  EXPECT_FALSE(checker.is_free({4.7, 0, 1}));
  EXPECT_FALSE(checker.is_flyable({4, 0, 1}, {6, 0, 1}));
  EXPECT_TRUE(checker.is_flyable({4, 0, 4}, {6, 0, 4}));
}

TEST(MotionChecker, counts_looks_at_cells_as_parts_of_a_body_query) {
  const GridMap map = wall_at_5_m();
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  EXPECT_EQ(checker.queries(), 0.0);
  (void)checker.is_free({1, 0, 1});
  (void)checker.is_flyable({1, 0, 1}, {2, 0, 1});
  EXPECT_NEAR(checker.clearance_m({1, 0, 1}, 10.0), 3.95, 1e-9);
  EXPECT_EQ(checker.queries(), 3.0);
  for (int i = 0; i < 16; ++i) {
    (void)checker.has_occupied({{0, 0, 0}, {1, 1, 1}});
  }
  EXPECT_EQ(checker.queries(), 4.0);
  EXPECT_FALSE(checker.is_flyable({1, 0, 1}, {1, 0, 2}));  // refused without a look at the map
  EXPECT_EQ(checker.queries(), 4.0);
}

/// A brick map that counts how often it is asked about a motion.
class CountedMap final : public flyball::OccupancyView, public flyball::Inflatable {
 public:
  explicit CountedMap(const flyball::BrickView& view) : view_{view} {}

  [[nodiscard]] double resolution_m() const override { return view_.resolution_m(); }
  [[nodiscard]] CellState state(const Vec3& p_W) const override { return view_.state(p_W); }
  [[nodiscard]] CellState body_state(const Vec3& p_WB, const Cylinder& body) const override {
    return view_.body_state(p_WB, body);
  }
  [[nodiscard]] bool has_occupied(const Aabb& box) const override {
    return view_.has_occupied(box);
  }
  [[nodiscard]] bool segment_hits(const Vec3& from,
                                  const Vec3& to,
                                  const Cylinder& body) const override {
    ++asked;
    return view_.segment_hits(from, to, body);
  }
  [[nodiscard]] double obstacle_density(const Vec3& p_W,
                                        double radius,
                                        double band) const override {
    return view_.obstacle_density(p_W, radius, band);
  }
  [[nodiscard]] double nearest_obstacle_m(const Vec3& p_W,
                                          double limit_m,
                                          double band_m) const override {
    return view_.nearest_obstacle_m(p_W, limit_m, band_m);
  }
  void inflate(const Aabb& box_W,
               const Cylinder& body,
               flyball::Obstruction by,
               flyball::InflatedWindow& window) const override {
    view_.inflate(box_W, body, by, window);
  }

  mutable int asked{};

 private:
  const flyball::BrickView& view_;
};

/// Single occupied cells in an open space of 32 x 32 x 8 m.
flyball::BrickMap scattered_map() {
  flyball::BrickMap map{0.2};
  std::mt19937_64 generator{3};
  std::vector<flyball::BrickMasks> changes;
  constexpr int middle = flyball::Lattice::half_keys / 4;
  for (int i = 0; i < 40 * 40 * 10; ++i) {
    const std::uint64_t hit =
        generator() % 40 == 0 ? std::uint64_t{1} << generator() % 64 : std::uint64_t{0};
    changes.push_back(
        {{middle + i % 40 - 20, middle + i / 40 % 40 - 20, middle + i / 1600 - 5}, ~hit, hit});
  }
  map.apply(changes);
  return map;
}

TEST(MotionChecker, answers_the_same_with_fewer_looks_where_motions_are_expected) {
  const flyball::BrickMap bricks = scattered_map();
  const flyball::BrickView view{bricks.cells()};
  const CountedMap map{view};
  const Aabb box{{-12, -12, -3}, {12, 12, 3}};
  MotionChecker plain{view, flyball::kit::slow_body(), 1.5};
  MotionChecker quick{map, flyball::kit::slow_body(), 1.5};
  quick.expect_motions_in(box);
  std::mt19937 generator{9};
  std::uniform_real_distribution<double> x{-12.5, 12.5};
  std::uniform_real_distribution<double> z{-3.1, 3.1};
  int flyable = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 from{x(generator), x(generator), z(generator)};
    const Vec3 to = from + Vec3{0.2 * x(generator), 0.2 * x(generator), 0.5 * z(generator)};
    const bool expected = plain.is_flyable(from, to);
    ASSERT_EQ(quick.is_flyable(from, to), expected) << from.transpose();
    flyable += expected ? 1 : 0;
  }
  EXPECT_EQ(quick.queries(), plain.queries());
  EXPECT_GT(flyable, 500);
  EXPECT_LT(map.asked, 3000 - flyable / 3);
  EXPECT_GT(map.asked, 3000 - flyable);  // the first ones, and those that leave the box
}

}  // namespace
