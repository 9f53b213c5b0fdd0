// SPDX-License-Identifier: BSD-3-Clause
#include "people/person_mesh.h"

#include "flyball/sim/colour_camera.h"

#include "scratch_folder.h"
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(PersonMesh, that_is_not_there_is_named_with_the_package_that_brings_it) {
  const auto mesh = load_person_mesh("walker", "/nowhere");
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::not_found);
  EXPECT_NE(mesh.error().message.find("/nowhere/human_rig.blend"), std::string::npos);
  EXPECT_NE(mesh.error().message.find("morse-simulator-data"), std::string::npos);
}

TEST(PersonMesh, of_an_unknown_look_is_refused_with_the_looks_that_there_are) {
  const auto mesh = load_person_mesh("giant", "/nowhere");
  ASSERT_FALSE(mesh.ok());
  for (const std::string& look : person_looks()) {
    EXPECT_NE(mesh.error().message.find(look), std::string::npos);
  }
}

TEST(PersonMesh, is_refused_where_the_file_holds_something_else) {
  const ScratchFolder folder;
  std::ofstream{std::filesystem::path{folder.path()} / "victim.blend"} << "BLENDER but not really";
  EXPECT_FALSE(load_person_mesh("victim", folder.path()).ok());
}

TEST(PersonMesh, stands_one_metre_tall_above_the_origin) {
  const auto mesh = load_person_mesh("victim", ColourCameraSpec{}.people_folder);
  if (!mesh) {
    GTEST_SKIP() << mesh.error().message;
  }
  float low = 1e9F;
  float high = -1e9F;
  for (const auto& p : mesh->vertices) {
    low = std::min(low, p[2]);
    high = std::max(high, p[2]);
  }
  EXPECT_NEAR(low, 0.0F, 1e-5F);
  EXPECT_NEAR(high, 1.0F, 1e-5F);
  EXPECT_EQ(mesh->parts.size(), mesh->triangles.size());
  EXPECT_GT(mesh->textures.front().width(), 1);
  for (const auto& corners : mesh->triangles) {
    ASSERT_LT(std::max({corners[0], corners[1], corners[2]}), mesh->vertices.size());
  }
}

// A figure of three points: feet, crown and nose; the nose looks along x.
TEST(PersonMesh, that_is_laid_down_looks_up_with_its_feet_in_front) {
  PersonMesh person;
  person.vertices = {{-0.1F, 0.0F, 0.0F}, {0.0F, 0.2F, 1.0F}, {0.1F, 0.0F, 0.9F}};
  person.normals = {-Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX()};
  lay_down(person);
  const auto at = [&](std::size_t i) { return Eigen::Vector3f{person.vertices[i].data()}; };
  EXPECT_TRUE(at(0).isApprox(Eigen::Vector3f{0.5F, 0.0F, 0.0F}));
  EXPECT_TRUE(at(1).isApprox(Eigen::Vector3f{-0.5F, 0.2F, 0.1F}));
  EXPECT_TRUE(at(2).isApprox(Eigen::Vector3f{-0.4F, 0.0F, 0.2F}));
  EXPECT_EQ(person.normals[0], Eigen::Vector3f::UnitX());
  EXPECT_EQ(person.normals[1], -Eigen::Vector3f::UnitX());
  EXPECT_EQ(person.normals[2], Eigen::Vector3f::UnitZ());
}

}  // namespace
}  // namespace flyball
