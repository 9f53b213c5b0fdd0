// SPDX-License-Identifier: BSD-3-Clause
#include "maps/layered_view.h"
#include "maps/octomap_tree.h"
#include "random_map.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr Cylinder body{0.35, 0.15};

TEST(LayeredView, calls_a_declared_cylinder_free_where_nothing_is_known) {
  octomap::OcTree tree{0.15};
  tree.updateNode(0.7, 0.0, 1.0, true);
  kit::TreesInView maps;
  maps.activate(tree);
  LayeredView& view = maps.view;
  const Cylinder space{1.0, 1.25};
  view.declare_clear({0, 0, 1.25}, space);
  EXPECT_EQ(view.state({0.5, 0.5, 2.0}), CellState::free);
  EXPECT_EQ(view.state({1.1, 0.0, 2.0}), CellState::unknown);
  EXPECT_EQ(view.body_state({0.7, 0.0, 1.0}, body), CellState::occupied);
  for (int i = 0; i < 16; ++i) {
    const double room_m = space.radius_m - body.radius_m;
    const Vec3 p{room_m * std::cos(0.4 * i), room_m * std::sin(0.4 * i), 1.9};
    EXPECT_EQ(view.body_state(p, body), CellState::free) << p.transpose();
    EXPECT_EQ(view.body_state(1.01 * p, body), CellState::unknown) << p.transpose();
  }
  EXPECT_EQ(view.body_state({0, 0, 2.35}, body), CellState::free);
  EXPECT_EQ(view.body_state({0, 0, 2.36}, body), CellState::unknown);
}

TEST(LayeredView, joins_declared_cylinders_and_known_free_space) {
  octomap::OcTree tree{0.15};
  for (int i = 0; i < 40 * 40 * 20; ++i) {
    const double x = 0.15 * (i % 40) + 0.675;  // free from x = .6 m on
    tree.updateNode(x, 0.15 * (i / 40 % 40) - 2.925, 0.15 * (i / 1600) + 0.075, false);
  }
  kit::TreesInView maps;
  maps.activate(tree);
  LayeredView& view = maps.view;
  view.declare_clear({0, 0, 1.25}, {1.0, 1.25});
  view.declare_clear({-1.2, 0, 1.25}, {1.0, 1.25});
  for (double x = -1.7; x < 3.0; x += 0.1) {
    EXPECT_EQ(view.body_state({x, 0, 1.2}, body), CellState::free) << x;
  }
  EXPECT_EQ(view.body_state({-1.9, 0, 1.2}, body), CellState::unknown);
}

TEST(LayeredView, keeps_wide_clear_cylinders_when_many_thin_ones_follow) {
  LayeredView view;
  view.declare_clear({0, 0, 1.25}, {1.0, 1.25});
  for (int i = 0; i < 100; ++i) {
    view.declare_clear({5.0 + i, 0, 1.0}, {0.4, 0.2});
  }
  EXPECT_EQ(view.state({0, 0, 1.0}), CellState::free);
  EXPECT_EQ(view.state({5.0, 0, 1.0}), CellState::unknown);
  EXPECT_EQ(view.state({104.0, 0, 1.0}), CellState::free);
}

}  // namespace
}  // namespace flyball
