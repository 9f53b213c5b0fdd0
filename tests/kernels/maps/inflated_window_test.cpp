// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/inflated_window.h"

#include "bricks/brick_map.h"
#include "bricks/brick_view.h"
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double cell_m = 0.15;
constexpr int middle = Lattice::half_keys;
const Aabb box_W{{-3.1, -2.0, -1.4}, {9.0, 2.3, 1.0}};  // wider than one word of cells

/// Mostly free, with holes and obstacles, over the box and what a body there can reach.
BrickMap random_map(unsigned seed, double unknown, double occupied) {
  BrickMap map{cell_m};
  std::mt19937_64 generator{seed};
  std::bernoulli_distribution is_unknown{unknown};
  std::bernoulli_distribution is_occupied{occupied};
  std::vector<BrickMasks> changes;
  for (int z = -5; z <= 5; ++z) {
    for (int y = -8; y <= 8; ++y) {
      for (int x = -10; x <= 20; ++x) {
        BrickMasks masks{{(middle >> 2) + x, (middle >> 2) + y, (middle >> 2) + z}, 0, 0};
        for (unsigned bit = 0; bit < 64; ++bit) {
          const std::uint64_t cell = std::uint64_t{1} << bit;
          masks.hit |= is_occupied(generator) ? cell : 0;
          masks.free |= is_unknown(generator) || (masks.hit & cell) != 0 ? 0 : cell;
        }
        changes.push_back(masks);
      }
    }
  }
  map.apply(changes);
  return map;
}

Vec3 random_point(std::mt19937& generator, const Aabb& box) {
  const auto unit = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  return box.min + Vec3{unit(), unit(), unit()}.cwiseProduct(box.max - box.min);
}

/// In its corners: declared cylinders, which are convex, hold it as a whole or not.
CellState worst_in(const OccupancyView& view, const CellKey& cell) {
  CellState worst = CellState::free;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto side = [&](unsigned axis) { return (corner >> axis & 1U) != 0 ? 1.0 - 1e-6 : 1e-6; };
    const Vec3 p = cell_m * Vec3{cell.x + side(0), cell.y + side(1), cell.z + side(2)};
    worst = std::max(worst, view.state(p));
  }
  return worst;
}

/// By definition: any cell in the way that is nearer to this one than the body is wide and high.
bool blocks_by_definition(const OccupancyView& view,
                          const CellKey& cell,
                          const Cylinder& body,
                          Obstruction by) {
  const int reach =
      static_cast<int>(std::ceil(std::max(body.radius_m, body.half_height_m) / cell_m));
  const auto gap = [](int cells) { return std::max(std::abs(cells) - 1, 0) * cell_m + 1e-9; };
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        if (std::hypot(gap(x), gap(y)) >= body.radius_m || gap(z) >= body.half_height_m) {
          continue;
        }
        const CellState state = worst_in(view, {cell.x + x, cell.y + y, cell.z + z});
        if (state == CellState::occupied ||
            (state == CellState::unknown && by == Obstruction::occupied_or_unknown)) {
          return true;
        }
      }
    }
  }
  return false;
}

TEST(InflatedWindow, has_a_bit_where_a_body_in_the_cell_can_reach_what_is_in_its_way) {
  const BrickMap map = random_map(1, 0.0002, 0.0005);
  BrickView view{map.cells()};
  view.declare_clear({1.0, 0.5, 0.0}, {2.0, 1.0});
  InflatedWindow window;
  std::mt19937 generator{3};
  for (const Cylinder& body : {Cylinder{0.45, 0.25}, Cylinder{0.2, 0.6}, Cylinder{0.8, 0.1}}) {
    for (const Obstruction by : {Obstruction::occupied, Obstruction::occupied_or_unknown}) {
      for (const int level : {0, 1, 2}) {
        view.activate(level);
        view.inflate(box_W, body, by, window);
        int blocked = 0;
        for (int i = 0; i < 500; ++i) {
          const Vec3 p = random_point(generator, box_W);
          const CellKey key = map.lattice().cell(p);
          const CellKey cell{key.x - middle, key.y - middle, key.z - middle};
          const bool expected = blocks_by_definition(view, cell, body, by);
          ASSERT_EQ(window.blocks(p), expected) << p.transpose() << " level " << level;
          blocked += expected ? 1 : 0;
        }
        EXPECT_GT(blocked, 20);
        EXPECT_LT(blocked, 490);
      }
    }
  }
}

TEST(InflatedWindow, lets_a_body_through_only_where_the_map_says_that_it_is_free) {
  constexpr Cylinder body{0.3, 0.2};
  const BrickMap map = random_map(2, 0.0003, 0.0003);
  BrickView view{map.cells()};
  view.declare_clear({2.0, 0.0, 0.0}, {1.5, 1.0});
  InflatedWindow window;
  view.inflate(box_W, body, Obstruction::occupied_or_unknown, window);
  std::mt19937 generator{5};
  int open = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random_point(generator, box_W);
    if (!window.blocks(p)) {
      ++open;
      ASSERT_EQ(view.body_state(p, body), CellState::free) << p.transpose();
    }
  }
  EXPECT_GT(open, 200);
}

TEST(InflatedWindow, lets_a_body_along_a_line_only_where_nothing_is_hit) {
  constexpr Cylinder body{0.3, 0.2};
  const BrickMap map = random_map(4, 0.0, 0.0002);
  const BrickView view{map.cells()};
  InflatedWindow window;
  view.inflate(box_W, body, Obstruction::occupied, window);
  std::mt19937 generator{6};
  int open = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from = random_point(generator, box_W);
    const Vec3 to = random_point(generator, box_W);
    const bool blocks = window.blocks(from, to);
    bool any = false;
    for (int k = 0; k <= 400; ++k) {
      any = any || window.blocks(Vec3{from + (to - from) * (k / 400.0)});
    }
    ASSERT_TRUE(blocks || !any);
    ASSERT_TRUE(blocks || !view.segment_hits(from, to, body));
    open += blocks ? 0 : 1;
  }
  EXPECT_GT(open, 100);
  EXPECT_LT(open, 1900);
}

TEST(InflatedWindow, crosses_the_same_cells_forth_and_back) {
  InflatedWindow window;
  window.lay_out({1.0, {0, 0, 0}, {100, 100, 100}});
  window.words()[50 * 2 * 100 + 50] = std::uint64_t{1} << 50U;  // cell (50, 50, 50)
  EXPECT_TRUE(window.blocks(Vec3{50.2, 50.9, 50.5}));
  EXPECT_FALSE(window.blocks(Vec3{49.9, 50.9, 50.5}));
  for (const Vec3& way : {Vec3{40, 0, 0}, Vec3{0, -40, 0}, Vec3{3, 2, 40}, Vec3{-31, 17, 5}}) {
    const Vec3 centre{50.5, 50.5, 50.5};
    EXPECT_TRUE(window.blocks(Vec3{centre - way}, Vec3{centre + way}));
    EXPECT_TRUE(window.blocks(Vec3{centre + way}, Vec3{centre - way}));
    const Vec3 beside = centre + Vec3{1.7, 1.7, -1.7};
    EXPECT_FALSE(window.blocks(Vec3{beside + way.cwiseAbs()}, beside));
  }
}

TEST(InflatedWindow, blocks_outside_itself_and_where_a_place_is_not_finite) {
  const BrickMap map = random_map(7, 0.0, 0.0);
  const BrickView view{map.cells()};
  InflatedWindow window;
  EXPECT_TRUE(window.blocks(Vec3{0, 0, 0}));
  view.inflate(box_W, {0.3, 0.2}, Obstruction::occupied_or_unknown, window);
  EXPECT_FALSE(window.blocks(Vec3{0, 0, 0}));
  EXPECT_FALSE(window.blocks(box_W.min));
  EXPECT_FALSE(window.blocks(box_W.min, box_W.max));
  for (const Vec3& p : {Vec3{-9, 0, 0}, Vec3{0, 1e300, 0}, Vec3{0, 0, std::nan("")}}) {
    EXPECT_TRUE(window.blocks(p));
    EXPECT_TRUE(window.blocks(Vec3{0, 0, 0}, p));
    EXPECT_TRUE(window.blocks(p, Vec3{0, 0, 0}));
  }
}

TEST(InflatedWindow, is_empty_where_the_map_has_no_keys_or_the_body_is_too_wide) {
  const BrickMap map = random_map(8, 0.0, 0.0);
  const BrickView view{map.cells()};
  InflatedWindow window;
  const auto blocks_in = [&](const Aabb& box, const Cylinder& body) {
    view.inflate(box, body, Obstruction::occupied, window);
    return window.blocks(Vec3{0.5 * (box.min + box.max)});
  };
  EXPECT_FALSE(blocks_in({{0, 0, 0}, {1, 1, 1}}, {0.3, 0.2}));
  EXPECT_TRUE(blocks_in({{4914.0, 0, 0}, {4915.0, 1, 1}}, {0.3, 0.2}));
  EXPECT_TRUE(blocks_in({{0, 0, 0}, {1, 1, 1}}, {30.0, 0.2}));
  EXPECT_TRUE(blocks_in({{0, 0, 0}, {1, std::nan(""), 1}}, {0.3, 0.2}));
  EXPECT_TRUE(blocks_in({{1, 1, 1}, {0, 0, 0}}, {0.3, 0.2}));
}

}  // namespace
}  // namespace flyball
