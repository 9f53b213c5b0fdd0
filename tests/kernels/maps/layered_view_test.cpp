// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "maps/layered_view.h"

#include "maps/octomap_tree.h"
#include "random_map.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::dense;
using kit::Fill;
using kit::random_point;
using kit::Rig;
using kit::sparse;
using kit::stacks;

constexpr Cylinder body{0.35, 0.15};

TEST(LayeredView, gives_the_worst_state_of_the_cubes_that_the_body_overlaps) {
  for (const auto& stack : stacks) {
    for (const Fill fill : {dense, sparse}) {
      const Rig rig{stack, fill};
      std::mt19937 generator{1};
      int seen[3] = {};
      for (int i = 0; i < 400; ++i) {
        const Vec3 p = random_point(generator, 3.5);
        const Cylinder space = i % 2 == 0 ? body : Cylinder{0.05, 0.05};
        const CellState expected = rig.reference->body_state(p, space);
        ASSERT_EQ(rig.view.body_state(p, space), expected) << p.transpose();
        ++seen[static_cast<int>(expected)];
      }
      EXPECT_GT(seen[1], 10);
      EXPECT_GT(seen[2], 10);
    }
  }
}

TEST(LayeredView, says_of_a_point_what_the_cell_around_it_is) {
  for (const auto& stack : stacks) {
    const Rig rig{stack, sparse};
    std::mt19937 generator{2};
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = random_point(generator, 3.5);
      ASSERT_EQ(rig.view.state(p), rig.reference->at(p)) << p.transpose();
    }
  }
}

TEST(LayeredView, finds_an_occupied_cube_in_a_box) {
  for (const auto& stack : stacks) {
    const Rig rig{stack, {0.90, 0.04}};
    std::mt19937 generator{3};
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 low = random_point(generator, 3.5);
      const Aabb box{low, low + random_point(generator, 0.8).cwiseAbs()};
      bool expected = false;
      rig.reference->visit(box, [&](const Aabb&, CellState state) {
        expected = expected || state == CellState::occupied;
      });
      ASSERT_EQ(rig.view.has_occupied(box), expected);
      hits += expected ? 1 : 0;
    }
    EXPECT_GT(hits, 20);
    EXPECT_LT(hits, 280);
  }
}

// Between two samples 2 mm apart the body moves less than the .5 mm by which the wider one is
// wider.
TEST(LayeredView, misses_no_hit_on_a_segment_and_invents_none) {
  for (const auto& stack : stacks) {
    const Rig rig{stack, {0.90, 0.02}};
    std::mt19937 generator{4};
    int hits = 0;
    for (int i = 0; i < 60; ++i) {
      const Vec3 from = random_point(generator, 3.0);
      const Vec3 to = i % 4 == 0 ? from + Vec3{0, 0, 0.5} : from + random_point(generator, 0.8);
      const Cylinder thin{0.12, 0.06};
      const Cylinder wide{thin.radius_m + 1e-3, thin.half_height_m + 1e-3};
      bool surely = false;
      bool maybe = false;
      const int steps = static_cast<int>(std::ceil((to - from).norm() / 0.002)) + 1;
      for (int k = 0; k <= steps; ++k) {
        const Vec3 p = from + static_cast<double>(k) / steps * (to - from);
        surely = surely || rig.view.body_state(p, thin) == CellState::occupied;
        maybe = maybe || rig.view.body_state(p, wide) == CellState::occupied;
      }
      const bool answer = rig.view.segment_hits(from, to, thin);
      ASSERT_TRUE(answer || !surely)
          << "missed between " << from.transpose() << " and " << to.transpose();
      ASSERT_TRUE(!answer || maybe)
          << "invented between " << from.transpose() << " and " << to.transpose();
      hits += answer ? 1 : 0;
    }
    EXPECT_GT(hits, 2);
    EXPECT_LT(hits, 58);
  }
}

TEST(LayeredView, lets_a_body_stand_against_a_wall) {
  octomap::OcTree tree{0.15};
  for (int y = -10; y < 10; ++y) {
    for (int z = 0; z < 10; ++z) {
      tree.updateNode(1.5 + 0.075, 0.15 * y + 0.075, 0.15 * z + 0.075, true);
    }
  }
  kit::TreesInView maps;
  maps.activate(tree);
  LayeredView& view = maps.view;
  EXPECT_EQ(view.body_state({1.5 - body.radius_m, 0.0, 0.75}, body), CellState::unknown);
  EXPECT_EQ(view.body_state({1.5 - body.radius_m + 1e-6, 0.0, 0.75}, body), CellState::occupied);
  EXPECT_FALSE(view.segment_hits({1.15, -1.0, 0.75}, {1.15, 1.0, 0.75}, body));
  EXPECT_TRUE(view.segment_hits({1.15, -1.0, 0.75}, {1.1501, 1.0, 0.75}, body));
}

TEST(LayeredView, sees_a_wall_at_the_far_end_of_300_metres) {
  octomap::OcTree tree{0.15};
  tree.updateNode(280.0, 0.0, 5.0, true);
  kit::TreesInView maps;
  maps.activate(tree);
  LayeredView& view = maps.view;
  EXPECT_TRUE(view.segment_hits({-20.0, 0.0, 5.0}, {300.0, 0.0, 5.0}, body));
  EXPECT_FALSE(view.segment_hits({-20.0, 0.0, 5.0}, {279.0, 0.0, 5.0}, body));
  EXPECT_FALSE(view.segment_hits({-20.0, 1.0, 5.0}, {300.0, 1.0, 5.0}, body));
}

TEST(LayeredView, knows_nothing_before_the_first_tree) {
  const LayeredView view;
  EXPECT_EQ(view.state({0, 0, 0}), CellState::unknown);
  EXPECT_EQ(view.body_state({0, 0, 0}, body), CellState::unknown);
  EXPECT_FALSE(view.segment_hits({0, 0, 0}, {9, 0, 0}, body));
  EXPECT_EQ(view.obstacle_density({0, 0, 0}, 10.0, 1.0), 0.0);
  EXPECT_EQ(view.nearest_obstacle_m({0, 0, 0}, 20.0, 1.0), 20.0);
  EXPECT_EQ(view.resolution_m(), LayeredView::initial_resolution_m);
}

TEST(LayeredView, never_calls_free_what_lies_outside_its_keys) {
  octomap::OcTree tree{0.15};
  tree.updateNode(0.0, 0.0, 0.0, false);
  kit::TreesInView maps;
  maps.activate(tree);
  LayeredView& view = maps.view;
  EXPECT_EQ(view.state({1e6, 0, 0}), CellState::unknown);
  EXPECT_EQ(view.body_state({1e6, 0, 0}, body), CellState::unknown);
  EXPECT_FALSE(view.segment_hits({1e6, 0, 0}, {2e6, 0, 0}, body));
}

TEST(LayeredView, trusts_no_place_that_is_not_finite) {
  LayeredView view;
  view.declare_clear({0, 0, 0}, {1.0, 1.0});
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(view.state({0, bad, 0}), CellState::unknown);
    EXPECT_EQ(view.body_state({0, bad, 0}, body), CellState::unknown);
    EXPECT_TRUE(view.segment_hits({0, 0, 0}, {0, 0, bad}, body));
  }
}

TEST(LayeredView, measures_density_in_columns_of_fixed_size) {
  for (const auto& stack : stacks) {
    const Rig rig{stack, {0.97, 0.002}};
    std::mt19937 generator{5};
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random_point(generator, 2.0);
      const double radius_m = 2.0;
      const double band_m = 0.5;
      int columns = 0;
      int filled = 0;
      for (int column = 0; column < 400; ++column) {
        const Vec3 low{0.8 * (column % 20 - 10), 0.8 * (column / 20 - 10), p.z() - band_m};
        const Aabb box{low + Vec3{1e-3, 1e-3, 0}, low + Vec3{0.8 - 1e-3, 0.8 - 1e-3, 2 * band_m}};
        if ((low + Vec3{0.4, 0.4, 0} - p).head<2>().norm() > radius_m) {
          continue;
        }
        ++columns;
        bool hit = false;
        rig.reference->visit(
            box, [&](const Aabb&, CellState state) { hit = hit || state == CellState::occupied; },
            false);
        filled += hit ? 1 : 0;
      }
      ASSERT_NEAR(rig.view.obstacle_density(p, radius_m, band_m),
                  static_cast<double>(filled) / columns, 1e-12);
    }
  }
}

TEST(LayeredView, leaves_the_ground_out_of_density_and_distance) {
  octomap::OcTree tree{0.15};
  for (int i = 0; i < 10000; ++i) {
    tree.updateNode(0.15 * (i % 100) - 7.5, 0.15 * (i / 100) - 7.5, 0.075, true);
  }
  tree.updateNode(3.0 + 0.075, 0.075, 2.0, true);
  kit::TreesInView maps;
  maps.activate(tree);
  LayeredView& view = maps.view;
  EXPECT_NEAR(view.obstacle_density({0, 0, 2.0}, 4.0, 1.0), 1.0 / 80, 0.001);
  EXPECT_GT(view.obstacle_density({0, 0, 0.5}, 4.0, 1.0), 0.99);
  EXPECT_NEAR(view.nearest_obstacle_m({0, 0, 2.0}, 20.0, 1.0), 3.0, 1e-9);
  EXPECT_NEAR(view.nearest_obstacle_m({0, 0, 2.0}, 20.0, 1.9), 1.85, 1e-9);
}

TEST(LayeredView, finds_the_nearest_obstacle_in_the_band) {
  for (const auto& stack : stacks) {
    const Rig rig{stack, {0.97, 0.001}};
    std::mt19937 generator{6};
    for (int i = 0; i < 10; ++i) {
      const Vec3 p = random_point(generator, 2.5);
      double nearest = 3.0;
      const double band_m = 0.7;
      rig.reference->visit(
          {p - Vec3{3, 3, band_m}, p + Vec3{3, 3, band_m}},
          [&](const Aabb& cube, CellState state) {
            if (state == CellState::occupied) {
              Vec3 low = cube.min;
              Vec3 high = cube.max;
              low.z() = std::max(low.z(), p.z() - band_m);
              high.z() = std::min(high.z(), p.z() + band_m);
              const Vec3 near = p.cwiseMax(low).cwiseMin(high);
              nearest = std::min(nearest, (near - p).norm());
            }
          },
          false);
      ASSERT_NEAR(rig.view.nearest_obstacle_m(p, 3.0, band_m), nearest, 1e-9);
    }
  }
}

}  // namespace
}  // namespace flyball
