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
  const auto grid = read_mesh(write("wall.obj", wall_obj), {0.1, 1.0});
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
  const auto grid = read_mesh(write("part.stl", stl), {0.05, 0.001, UpAxis::y});
  ASSERT_TRUE(grid) << grid.error().message;
  const Aabb extent = grid->extent_W();
  EXPECT_NEAR(extent.min.z(), 1.0, 0.051);
  EXPECT_NEAR(extent.max.z(), 3.0, 0.051);
  EXPECT_NEAR(extent.min.y(), -0.25, 0.051);
  EXPECT_NEAR(extent.max.x(), 0.5, 0.051);
}

TEST_F(MeshText, the_formats_that_are_named_give_the_same_cells) {
  const char* ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "2.05 -1 0\n2.05 1 0\n2.05 1 2\n2.05 -1 2\n4 0 1 2 3\n";
  const auto from_obj = read_mesh(write("wall.obj", wall_obj), {0.1, 1.0});
  const auto from_ply = read_mesh(write("wall.ply", ply), {0.1, 1.0});
  ASSERT_TRUE(from_obj && from_ply);
  EXPECT_EQ(from_obj->low(), from_ply->low());
  EXPECT_EQ(from_obj->high(), from_ply->high());
}

TEST_F(MeshText, refuses_what_is_no_mesh) {
  const auto missing = read_mesh(scratch.path("none.obj"), {});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  std::filesystem::create_symlink("loop.obj", scratch.path("loop.obj"));
  const auto barred = read_mesh(scratch.path("loop.obj"), {});
  ASSERT_FALSE(barred);
  EXPECT_EQ(barred.error().code, ErrorCode::unavailable) << barred.error().message;
  const auto text = read_mesh(write("text.obj", "hello\n"), {});
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::invalid_input);
}

/// A triangle from z = 3 to z = 7 of the file, whatever axis it calls up.
std::string collada(const char* up_axis) {
  return std::string{
             "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/"
             "COLLADASchema\" version=\"1.4.1\"><asset><up_axis>"} +
         up_axis +
         "</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
         "<float_array id=\"a\" count=\"9\">1 2 3 4 2 3 1 5 7</float_array><technique_common>"
         "<accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
         "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>"
         "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
         "source=\"#p\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" "
         "source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
         "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node id=\"n\">"
         "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes><scene>"
         "<instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
}

TEST_F(MeshText, of_collada_stands_as_the_file_says_whatever_is_asked_for) {
  const std::string z_up = write("z.dae", collada("Z_UP"));
  const std::string y_up = write("y.dae", collada("Y_UP"));
  for (const UpAxis up : {UpAxis::file, UpAxis::y, UpAxis::z}) {
    const auto grid = read_mesh(z_up, {0.1, 1.0, up});
    ASSERT_TRUE(grid) << grid.error().message;
    EXPECT_TRUE(grid->extent_W().min.isApprox(Vec3{1.0, 2.0, 3.0}, 0.051));
    EXPECT_TRUE(grid->extent_W().max.isApprox(Vec3{4.1, 5.1, 7.1}, 0.051));
    const auto turned = read_mesh(y_up, {0.1, 1.0, up});
    ASSERT_TRUE(turned) << turned.error().message;
    EXPECT_NEAR(turned->extent_W().min.z(), 2.0, 0.11);
    EXPECT_NEAR(turned->extent_W().max.z(), 5.0, 0.11);
  }
}

TEST_F(MeshText, of_gltf_has_y_up_unless_it_is_told_otherwise) {
  const std::string path =
      write("part.gltf",
            "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
            "\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
            "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
            "\"min\":[0,0,0],\"max\":[1,1,1]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
            "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
            // (0, 0, 0), (1, 0, 0), (0, 2, 1)
            "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAIA/\"}]}\n");
  for (const auto& [up, height_m] : {std::pair{UpAxis::file, 2.0}, {UpAxis::z, 1.0}}) {
    const auto grid = read_mesh(path, {0.1, 1.0, up});
    ASSERT_TRUE(grid) << grid.error().message;
    EXPECT_NEAR(grid->extent_W().max.z(), height_m, 0.11);
  }
}

TEST_F(MeshText, that_makes_assimp_loop_or_abort_is_refused) {
  const std::string short_ply = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x";
  const std::string asserting_ply =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
      "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "0 -10 0\n20 -10 0\n20 10 0\n0 10 0\n20 -10 4\n20 10 4\n0 10 4.00";
  for (const auto& [text, reason] : {std::pair{short_ply, "takes more than 1 s"},
                                     {short_ply + "\nproperty float y\npropert", "more than 1 s"},
                                     {asserting_ply, "signal 6"}}) {
    const auto grid = read_mesh(write("found.ply", text), {0.1, 1.0, UpAxis::z, 1});
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::invalid_input);
    EXPECT_NE(grid.error().message.find(reason), std::string::npos) << grid.error().message;
    EXPECT_NE(grid.error().message.find("found.ply"), std::string::npos);
  }
}

TEST_F(MeshText, that_assimp_refuses_is_refused_with_its_reason) {
  const auto tiny = read_mesh(write("text.obj", "hello\n"), {});
  ASSERT_FALSE(tiny);
  EXPECT_NE(tiny.error().message.find("OBJ-file is too small"), std::string::npos)
      << tiny.error().message;
  const auto unknown = read_mesh(write("text.foo", "hello\n"), {});
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("No suitable reader found"), std::string::npos)
      << unknown.error().message;
}

TEST_F(MeshText, with_a_corner_that_is_nowhere_is_refused) {
  for (const char* number : {"nan", "1e39", "inf"}) {
    const auto grid = read_mesh(
        write("wall.obj", std::string{"v 0 0 0\nv 1 0 "} + number + "\nv 0 1 0\nf 1 2 3\n"), {});
    EXPECT_FALSE(grid) << number;
  }
}

TEST_F(MeshText, of_triangles_that_would_take_hours_to_mark_is_refused) {
  std::string text = "v 0 0 0\nv 50 0 50\nv 0 50 50\n";  // 1.25e8 cells around it.
  for (int i = 0; i < 40; ++i) {
    text += "f 1 2 3\n";
  }
  const auto grid = read_mesh(write("stack.obj", text), {0.1, 1.0});
  ASSERT_FALSE(grid);
  EXPECT_NE(grid.error().message.find("set a larger cell_m"), std::string::npos);
}

TEST_F(MeshText, that_is_a_folder_is_not_found) {
  EXPECT_EQ(read_mesh(scratch.path(), {}).error().code, ErrorCode::not_found);
}

TEST_F(MeshText, refuses_more_cells_than_fit) {
  const auto grid = read_mesh(write("wall.obj", wall_obj), {0.02, 1000.0});
  ASSERT_FALSE(grid);
  EXPECT_NE(grid.error().message.find("metres_per_unit"), std::string::npos);
}

}  // namespace
}  // namespace flyball
