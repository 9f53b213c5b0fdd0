// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "bricks/brick_view.h"

#include "bricks/brick_map.h"
#include "random_map.h"
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::Fill;
using kit::random_point;

constexpr double finest_m = 0.2;
constexpr Cylinder body{0.35, 0.15};
constexpr int levels = 4;

/// The masks that make a brick map of a tree with cells of 1 or -1.
std::vector<BrickMasks> masks_of(const octomap::OcTree& tree) {
  std::vector<BrickMasks> changes;
  constexpr int first = (Lattice::half_keys - 16) / 4;  // the random trees are 32 cells wide
  for (int brick = 0; brick < 512; ++brick) {
    BrickMasks change;
    change.brick = {first + brick % 8, first + brick / 8 % 8, first + brick / 64};
    for (int bit = 0; bit < 64; ++bit) {
      const auto key = [](int brick_key, int offset) {
        return static_cast<octomap::key_type>(4 * brick_key + (offset & 3));
      };
      const octomap::OcTreeKey cell{key(change.brick.x, bit), key(change.brick.y, bit >> 2),
                                    key(change.brick.z, bit >> 4)};
      const auto* node = tree.search(cell);
      if (node != nullptr) {
        (tree.isNodeOccupied(node) ? change.hit : change.free) |= std::uint64_t{1} << bit;
      }
    }
    changes.push_back(change);
  }
  return changes;
}

/// The same random map twice. For a coarse level the tree view is told which of the coarse cells
/// hold an obstacle, and asks the fine tree about the rest.
struct Twins {
  std::unique_ptr<octomap::OcTree> fine;
  std::unique_ptr<octomap::OcTree> coarse;
  kit::TreesInView trees{};
  const LayeredView& expected{trees.view};
  BrickMap map{finest_m};
  BrickView view{map.cells()};

  Twins(int level, Fill fill) : fine{kit::random_tree(finest_m, fill, 7)} {
    trees.activate(*fine);
    map.apply(masks_of(*fine));
    view.activate(level);
    if (level > 0) {
      coarse = std::make_unique<octomap::OcTree>(finest_m * (1 << level));
      for (auto leaf = fine->begin_leafs(); leaf != fine->end_leafs(); ++leaf) {
        if (fine->isNodeOccupied(*leaf)) {
          coarse->setNodeValue(leaf.getX(), leaf.getY(), leaf.getZ(), 1.0F);
        }
      }
      trees.activate(*coarse);
    }
  }
};

TEST(BrickView, answers_for_points_and_bodies_as_the_tree_view_does) {
  for (int level = 0; level < levels; ++level) {
    for (const Fill fill : {Fill{0.97, 0.002}, Fill{0.40, 0.005}}) {
      const Twins twins{level, fill};
      std::mt19937 generator{1};
      int seen[3] = {};
      for (int i = 0; i < 400; ++i) {
        const Vec3 p = random_point(generator, 3.5);
        const Cylinder space = i % 2 == 0 ? body : Cylinder{0.05, 0.05};
        ASSERT_EQ(twins.view.state(p), twins.expected.state(p)) << p.transpose();
        const CellState expected = twins.expected.body_state(p, space);
        ASSERT_EQ(twins.view.body_state(p, space), expected) << "level " << level;
        ++seen[static_cast<int>(expected)];
      }
      EXPECT_GT(seen[1], 10);
      EXPECT_GT(seen[2], 10);
    }
  }
}

TEST(BrickView, finds_occupied_cubes_in_boxes_and_on_segments_as_the_tree_view_does) {
  for (int level = 0; level < levels; ++level) {
    const Twins twins{level, {0.90, 0.003}};
    std::mt19937 generator{3};
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 low = random_point(generator, 3.5);
      const Aabb box{low, low + random_point(generator, 0.8).cwiseAbs()};
      ASSERT_EQ(twins.view.has_occupied(box), twins.expected.has_occupied(box));
      const Vec3 to = i % 4 == 0 ? low + Vec3{0, 0, 0.5} : low + random_point(generator, 2.0);
      const Cylinder thin{0.12, 0.06};
      const bool expected = twins.expected.segment_hits(low, to, thin);
      ASSERT_EQ(twins.view.segment_hits(low, to, thin), expected);
      hits += expected ? 1 : 0;
    }
    EXPECT_GT(hits, 10);
    EXPECT_LT(hits, 290);
  }
}

TEST(BrickView, measures_density_and_distance_as_the_tree_view_does) {
  for (int level = 0; level < levels; ++level) {
    const Twins twins{level, {0.97, 0.0005}};
    std::mt19937 generator{5};
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random_point(generator, 2.5);
      ASSERT_EQ(twins.view.obstacle_density(p, 2.0, 0.5),
                twins.expected.obstacle_density(p, 2.0, 0.5));
      ASSERT_NEAR(twins.view.nearest_obstacle_m(p, 3.0, 0.7),
                  twins.expected.nearest_obstacle_m(p, 3.0, 0.7), 1e-12);
    }
  }
}

TEST(BrickView, lists_every_occupied_cell_once) {
  for (int level = 0; level < levels; ++level) {
    const Twins twins{level, {0.40, 0.01}};
    const double edge_m = finest_m * (1 << level);
    const int cells = 32 >> level;
    std::size_t expected = 0;
    for (int i = 0; i < cells * cells * cells; ++i) {
      const Vec3 cell{i % cells - cells / 2 + 0.5, i / cells % cells - cells / 2 + 0.5,
                      i / cells / cells - cells / 2 + 0.5};
      expected += twins.view.state(edge_m * cell) == CellState::occupied ? 1 : 0;
    }
    std::size_t shown = 0;
    twins.view.for_each_occupied([&](const Aabb& cube) {
      ++shown;
      EXPECT_NEAR((cube.max - cube.min).maxCoeff(), edge_m, 1e-12);
      EXPECT_EQ(twins.view.state(0.5 * (cube.min + cube.max)), CellState::occupied);
    });
    EXPECT_EQ(shown, expected);
  }
}

TEST(BrickView, sees_a_wall_at_the_far_end_of_300_metres) {
  BrickMap map{0.15};
  const CellKey cell = map.lattice().cell({280.0, 0.0, 5.0});
  map.apply({{cell.above(brick_level), 0, std::uint64_t{1} << bit_in_brick(cell)}});
  const BrickView view{map.cells()};
  EXPECT_TRUE(view.segment_hits({-20.0, 0.0, 5.0}, {300.0, 0.0, 5.0}, body));
  EXPECT_TRUE(view.segment_hits({-20.0, -40.0, 5.0}, {300.0, 2.6, 5.0}, body));
  EXPECT_FALSE(view.segment_hits({-20.0, 0.0, 5.0}, {279.0, 0.0, 5.0}, body));
  EXPECT_FALSE(view.segment_hits({-20.0, 1.0, 5.0}, {300.0, 1.0, 5.0}, body));
}

TEST(BrickView, knows_nothing_before_the_first_scan_nor_outside_its_keys) {
  const BrickMap map{0.15};
  BrickView view{map.cells()};
  view.declare_clear({0, 0, 0}, {1.0, 1.0});
  for (const Vec3& p : {Vec3{5, 5, 5}, Vec3{1e6, 0, 0}, Vec3{-1e300, 0, 0}}) {
    EXPECT_EQ(view.state(p), CellState::unknown);
    EXPECT_EQ(view.body_state(p, body), CellState::unknown);
    EXPECT_FALSE(view.segment_hits(p, p + Vec3{9, 0, 0}, body));
  }
  EXPECT_EQ(view.obstacle_density({0, 0, 0}, 10.0, 1.0), 0.0);
  EXPECT_EQ(view.nearest_obstacle_m({0, 0, 0}, 20.0, 1.0), 20.0);
  EXPECT_EQ(view.resolution_m(), 0.15);
  EXPECT_EQ(view.state({0.5, 0.5, 0.5}), CellState::free);
  EXPECT_EQ(view.body_state({0.3, 0.3, 0.5}, body), CellState::free);
  EXPECT_EQ(view.body_state({0.8, 0.3, 0.5}, body), CellState::unknown);
}

TEST(BrickView, trusts_no_place_that_is_not_finite) {
  const BrickMap map{0.15};
  BrickView view{map.cells()};
  view.declare_clear({0, 0, 0}, {1.0, 1.0});
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(view.state({0, bad, 0}), CellState::unknown);
    EXPECT_EQ(view.body_state({0, bad, 0}, body), CellState::unknown);
    EXPECT_TRUE(view.segment_hits({0, 0, 0}, {0, 0, bad}, body));
  }
}

TEST(BrickView, treats_declared_cylinders_as_the_tree_view_does) {
  Twins twins{1, {0.40, 0.002}};
  for (const Vec3& centre : {Vec3{0, 0, 0}, Vec3{1.2, 0, 0.2}, Vec3{-0.8, 0.9, -0.5}}) {
    twins.trees.view.declare_clear(centre, {1.0, 1.25});
    twins.view.declare_clear(centre, {1.0, 1.25});
  }
  std::mt19937 generator{8};
  int seen[3] = {};
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_point(generator, 2.0);
    ASSERT_EQ(twins.view.state(p), twins.expected.state(p));
    const CellState expected = twins.expected.body_state(p, {0.2, 0.1});
    ASSERT_EQ(twins.view.body_state(p, {0.2, 0.1}), expected);
    ++seen[static_cast<int>(expected)];
  }
  EXPECT_GT(seen[0], 10);
}

}  // namespace
}  // namespace flyball
