// SPDX-License-Identifier: BSD-3-Clause
#include "scans/packed_cell.h"

#include "bricks/brick_map.h"
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

void expect_packed(const Lattice& lattice, const Vec3& p) {
  const CellKey cell = lattice.cell(p);
  PackedCell packed_cell{};
  ASSERT_TRUE(packed::pack(p, lattice.cells_per_m(), packed_cell)) << p.transpose();
  const auto key = [](int k) { return static_cast<std::uint64_t>(k); };
  ASSERT_EQ(packed_cell, packed::bits(key(cell.x), key(cell.y), key(cell.z))) << p.transpose();
  ASSERT_EQ(packed::chunk(packed_cell), packed::chunk(cell.above(chunk_level)));
  ASSERT_EQ(packed::brick_number_at[packed::brick_place(packed_cell)],
            brick_number(cell.above(brick_level)));
  ASSERT_EQ(packed::bit(packed_cell), bit_in_brick(cell));
}

TEST(PackedCell, names_the_cell_chunk_brick_and_bit_that_the_lattice_names) {
  for (const double finest_m : {0.15, 0.2, 0.25, 0.0371}) {
    const Lattice lattice{finest_m};
    std::mt19937 generator{11};
    const double half_m = 0.999 * lattice.edge_m();
    std::uniform_real_distribution<double> wide{-half_m, half_m};
    std::uniform_real_distribution<double> narrow{-30.0, 30.0};
    for (int i = 0; i < 3000; ++i) {
      auto& range = i % 2 == 0 ? wide : narrow;
      expect_packed(lattice, {range(generator), range(generator), range(generator)});
    }
  }
}

TEST(PackedCell, rounds_at_the_borders_of_cells_as_the_lattice_does) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double finest_m : {0.15, 0.2, 0.25}) {
    const Lattice lattice{finest_m};
    for (int k = -3000; k < 3000; ++k) {
      const double border = k * finest_m;
      const double below = std::nextafter(border, -infinity);
      expect_packed(lattice, {border, below, std::nextafter(border, infinity)});
      expect_packed(lattice, {below, border, std::nextafter(below, -infinity)});
    }
    const double least = std::numeric_limits<double>::denorm_min();
    expect_packed(lattice, {-least, least, -1e-17});
    expect_packed(lattice, {0.0, -0.0, -1e-12});
  }
}

TEST(PackedCell, knows_no_cell_outside_the_lattice_nor_where_a_number_is_not_finite) {
  const Lattice lattice{0.15};
  const double edge = lattice.edge_m();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad :
       {1.001 * edge, -1.001 * edge, 1e9, -1e9, 1e15, -1e15, 4e15, -4e15, 7e14, -7e14, 1e300,
        -1e300, infinity, -infinity, std::nan(""), -std::nan("")}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p{1.0, -2.0, 3.0};
      p[axis] = bad;
      PackedCell cell{};
      EXPECT_FALSE(packed::pack(p, lattice.cells_per_m(), cell)) << p.transpose();
    }
  }
}

TEST(PackedCell, gives_near_chunks_numbers_of_their_own) {
  std::vector<bool> taken(32 * 32 * 8, false);
  for (int z = 1020; z < 1028; ++z) {
    for (int y = 1000; y < 1032; ++y) {
      for (int x = 990; x < 1022; ++x) {
        const std::size_t number = packed::near_number(packed::chunk(CellKey{x, y, z}));
        ASSERT_LT(number, taken.size());
        ASSERT_FALSE(taken[number]);
        taken[number] = true;
      }
    }
  }
}

}  // namespace
}  // namespace flyball
