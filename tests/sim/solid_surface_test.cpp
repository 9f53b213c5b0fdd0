// SPDX-License-Identifier: BSD-3-Clause
#include "world/solid_surface.h"

#include "flyball/runtime/random.h"

#include "scratch_folder.h"
#include <fstream>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Triangle = std::array<Vec3, 3>;

const Aabb unit_box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};

Vec3 random_point(RandomStream& random) {
  Vec3 p;
  for (double& component : p) {
    component = random.uniform(-1.5, 2.5);
  }
  return p;
}

/// The least distance that it looks for is that of a point of the triangle to the box, sampled.
bool comes_near(const Triangle& t, double margin_m) {
  constexpr int steps = 60;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double a = static_cast<double>(i) / steps;
      const double b = static_cast<double>(j) / steps;
      const Vec3 p = t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
      if ((p - p.cwiseMax(unit_box.min).cwiseMin(unit_box.max)).norm() <= margin_m) {
        return true;
      }
    }
  }
  return false;
}

TEST(Touches, agrees_with_points_of_the_triangle) {
  RandomStream random{5, "solid_surface_test"};
  int touching = 0;
  for (int i = 0; i < 600; ++i) {
    const Vec3 a = random_point(random);
    const Vec3 b = random_point(random);
    const Triangle triangle{a, b, random_point(random)};
    const bool is_touching = touches(triangle, unit_box);
    touching += is_touching ? 1 : 0;
    EXPECT_TRUE(is_touching || !comes_near(triangle, 0.0)) << i;
    EXPECT_TRUE(!is_touching || comes_near(triangle, 0.12)) << i;  // As far apart as samples are.
  }
  EXPECT_GT(touching, 100);
  EXPECT_LT(touching, 500);
}

TEST(Touches, counts_a_face_that_is_shared) {
  EXPECT_TRUE(touches({Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 0, 1}}, unit_box));
  EXPECT_FALSE(touches({Vec3{1.01, 0, 0}, Vec3{1.01, 1, 0}, Vec3{1.01, 0, 1}}, unit_box));
}

class MeshText : public testing::Test {
 protected:
  std::string write(const char* name, const std::string& text) const {
    const std::string path = scratch.path(name);
    std::ofstream{path} << text;
    return path;
  }
  const ScratchFolder scratch;
};

constexpr const char* wall_obj = "v 2.05 -1 0\nv 2.05 1 0\nv 2.05 1 2\nv 2.05 -1 2\nf 1 2 3 4\n";

TEST_F(MeshText, a_wall_is_one_cell_thick_where_it_stands) {
  const auto grid = read_mesh(write("wall.obj", wall_obj), {0.1, 1.0, false});
  ASSERT_TRUE(grid) << grid.error().message;
  const auto boxes = merged_boxes(
      *grid, [&](const ScanGrid::Index& cell) { return grid->state(cell) == CellState::occupied; });
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes.front().min.x(), 2.0, 1e-9);
  EXPECT_NEAR(boxes.front().max.x(), 2.1, 1e-9);
  EXPECT_LE(boxes.front().min.y(), -1.0);
  EXPECT_GE(boxes.front().max.y(), 1.0);
  EXPECT_GE(boxes.front().max.z(), 2.0);
}

TEST_F(MeshText, is_turned_and_scaled_as_it_is_told) {
  const char* stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 1000 0\nvertex 500 1000 0\n"
      "vertex 0 3000 250\nendloop\nendfacet\nendsolid s\n";
  const auto grid = read_mesh(write("part.stl", stl), {0.05, 0.001, true});
  ASSERT_TRUE(grid) << grid.error().message;
  const Aabb extent = grid->extent_W();
  EXPECT_NEAR(extent.min.z(), 1.0, 0.051);
  EXPECT_NEAR(extent.max.z(), 3.0, 0.051);
  EXPECT_NEAR(extent.min.y(), -0.25, 0.051);
  EXPECT_NEAR(extent.max.x(), 0.5, 0.051);
}

TEST_F(MeshText, the_formats_that_are_promised_give_the_same_cells) {
  const char* ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "2.05 -1 0\n2.05 1 0\n2.05 1 2\n2.05 -1 2\n4 0 1 2 3\n";
  const auto from_obj = read_mesh(write("wall.obj", wall_obj), {0.1, 1.0, false});
  const auto from_ply = read_mesh(write("wall.ply", ply), {0.1, 1.0, false});
  ASSERT_TRUE(from_obj && from_ply);
  EXPECT_EQ(from_obj->low(), from_ply->low());
  EXPECT_EQ(from_obj->high(), from_ply->high());
}

TEST_F(MeshText, refuses_what_is_no_mesh) {
  const auto missing = read_mesh(scratch.path("none.obj"), {});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  const auto text = read_mesh(write("text.obj", "hello\n"), {});
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::invalid_input);
}

TEST_F(MeshText, refuses_more_cells_than_fit) {
  const auto grid = read_mesh(write("wall.obj", wall_obj), {0.02, 1000.0, false});
  ASSERT_FALSE(grid);
  EXPECT_NE(grid.error().message.find("metres_per_unit"), std::string::npos);
}

}  // namespace
}  // namespace flyball
