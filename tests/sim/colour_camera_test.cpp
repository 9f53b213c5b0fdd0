// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/colour_camera.h"

#include <array>
#include <thread>

#include <gtest/gtest.h>

namespace flyball {
namespace {

ColourCameraSpec small_camera() {
  ColourCameraSpec spec;
  spec.width_px = 32;
  spec.height_px = 24;
  return spec;
}

/// Level, looking along x.
Pose looking_east(const Vec3& p_W) {
  Pose X_WC = Pose::Identity();
  X_WC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  X_WC.translation() = p_W;
  return X_WC;
}

Pose looking_down(const Vec3& p_W) {
  Pose X_WC = Pose::Identity();
  X_WC.linear() << 0, -1, 0, -1, 0, 0, 0, 0, -1;
  X_WC.translation() = p_W;
  return X_WC;
}

MissionTime at_s(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

struct Rgb {
  int red;
  int green;
  int blue;
};

Rgb pixel(const ColourImage& image, int x, int y) {
  const auto i = 3 * static_cast<std::size_t>(y * image.camera.width_px + x);
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

int brightness(const ColourImage& image) {
  int sum = 0;
  for (const std::uint8_t value : image.rgb) {
    sum += value;
  }
  return sum / static_cast<int>(image.rgb.size());
}

TEST(ColourCamera, sees_blue_sky_above_green_grass) {
  const World world;
  const auto camera = ColourCamera::make(world, small_camera());
  ASSERT_TRUE(camera.ok());
  const ColourImage image = (*camera)->capture(looking_east({0.0, 0.0, 2.0}), MissionTime{}, 7);
  EXPECT_EQ(image.sequence, 7U);
  ASSERT_EQ(image.rgb.size(), 3U * 32U * 24U);
  const Rgb sky = pixel(image, 16, 0);
  const Rgb ground = pixel(image, 16, 23);
  EXPECT_GT(sky.blue, sky.red);
  EXPECT_GT(ground.green, ground.blue + 20);
}

TEST(ColourCamera, sees_a_roofs_shadow_on_the_ground) {
  World world;
  ColourCameraSpec spec = small_camera();
  spec.sun_elevation_rad = 1.5;
  const Pose X_WC = looking_down({0.0, 0.0, 2.0});
  const auto open = ColourCamera::make(world, spec);
  world.boxes.push_back({{-9.0, -9.0, 4.0}, {9.0, 9.0, 4.2}});
  const auto roofed = ColourCamera::make(world, spec);
  const int lit = brightness((*open)->capture(X_WC, MissionTime{}, 0));
  const int shaded = brightness((*roofed)->capture(X_WC, MissionTime{}, 0));
  EXPECT_LT(shaded, lit * 7 / 10);
  EXPECT_GT(shaded, lit / 10);
}

TEST(ColourCamera, paints_each_solid_in_its_material) {
  World world;
  world.boxes = {{{4.0, -9.0, 0.0}, {5.0, 0.0, 9.0}}, {{4.0, 0.0, 0.0}, {5.0, 9.0, 9.0}}};
  world.box_materials = {Material::brick};  // The one to the right; plaster to the left.
  const auto camera = ColourCamera::make(world, small_camera());
  const ColourImage image = (*camera)->capture(looking_east({0.0, 0.0, 1.0}), MissionTime{}, 0);
  const Rgb left = pixel(image, 8, 6);
  const Rgb right = pixel(image, 24, 6);
  EXPECT_GT(right.red - right.blue, 2 * (left.red - left.blue));
}

TEST(ColourCamera, gives_the_same_image_again_whatever_it_saw_between) {
  World world;
  world.boxes.push_back({{4.0, -1.0, 0.0}, {5.0, 1.0, 1.0}});
  const auto camera = ColourCamera::make(world, small_camera());
  const Pose X_WC = looking_east({0.0, 0.0, 1.0});
  const ColourFrame late = (*camera)->frame({X_WC, Pose::Identity()}, at_s(5.0), 1);
  const auto first = (*camera)->capture(X_WC, at_s(5.0), 1);
  EXPECT_NE((*camera)->capture(looking_down({0.0, 0.0, 3.0}), at_s(1.0), 0).rgb, first.rgb);
  EXPECT_EQ(late.image.value().rgb, first.rgb);
}

TEST(ColourCamera, renders_a_part_as_it_renders_the_whole) {
  World world;
  world.boxes.push_back({{4.0, -1.0, 0.0}, {5.0, 1.0, 1.0}});
  world.pillars.push_back({{3.0, 0.5, 0.0}, 0.3, 2.0, Material::leaves});
  const auto camera = ColourCamera::make(world, small_camera());
  Pose X_WC = looking_east({0.0, 0.1, 1.3});
  X_WC.linear() = X_WC.linear() * Eigen::AngleAxisd{0.3, Vec3{1.0, 0.2, 0.4}.normalized()};
  const ColourImage all = (*camera)->capture(X_WC, at_s(5.0), 1);
  for (const PixelRegion& region :
       {PixelRegion{0, 0, 32, 24}, PixelRegion{7, 3, 9, 14}, PixelRegion{31, 23, 1, 1}}) {
    const ColourFrame frame = (*camera)->frame({X_WC, Pose::Identity()}, at_s(5.0), 1);
    EXPECT_EQ(frame.image.part(region).rgb, cut(all, region).rgb) << region.x_px;
    EXPECT_EQ(frame.image.value().rgb, all.rgb) << "after a part";
  }
}

TEST(ColourCamera, sees_a_mover_where_it_is_and_its_pattern_goes_along) {
  World world;
  Mover lorry;
  lorry.size_m = {2.0, 3.0, 3.0};
  lorry.from_W = {7.0, -20.0, 0.0};
  lorry.to_W = {7.0, 20.0, 0.0};
  lorry.speed_m_s = 4.0;
  world.movers = {lorry};
  const auto camera = ColourCamera::make(world, small_camera());
  ASSERT_TRUE(camera.ok());
  const auto empty = ColourCamera::make(World{}, small_camera());
  const auto seen = [](const ColourCamera& by, double y_m, double t_s) {
    return by.capture(looking_east({0.0, y_m, 1.0}), at_s(t_s), 0);
  };
  const ColourImage here = seen(**camera, 0.0, 5.0);
  const ColourImage gone = seen(**camera, 0.0, 0.0);
  const ColourImage grass = seen(**empty, 0.0, 0.0);
  const ColourImage later = seen(**camera, 4.0, 6.0);  // The lorry is 4 m on, and so is the camera.
  for (int i = 0; i < 2 * 5; ++i) {                    // Two rows between the horizon and its foot.
    const int x = 14 + i % 5;
    const int y = 13 + i / 5;
    EXPECT_GT(pixel(here, x, y).blue, pixel(grass, x, y).blue + 20);
    EXPECT_EQ(pixel(gone, x, y).blue, pixel(grass, x, y).blue) << "it is 20 m to the south";
    EXPECT_NEAR(pixel(later, x, y).red, pixel(here, x, y).red, 1) << "the same place on it";
  }
}

class SomebodyWalks : public testing::Test {
 protected:
  void SetUp() override {
    Person person;
    person.look = "victim";
    person.walk = {{0.0, {6.0, -6.0, 0.0}}, {10.0, {6.0, 6.0, 0.0}}};
    world.people = {person};
    spec.width_px = 64;
    spec.height_px = 48;
    auto made = ColourCamera::make(world, spec);
    if (!made) {
      GTEST_SKIP() << made.error().message;
    }
    camera = std::move(*made);
  }
  World world;
  ColourCameraSpec spec;
  std::unique_ptr<ColourCamera> camera;
};

TEST_F(SomebodyWalks, and_the_image_changes_inside_the_persons_box_and_shadow_only) {
  spec.sun_elevation_rad = 1.57;  // No shadow beside the feet.
  camera = std::move(*ColourCamera::make(world, spec));
  const Pose X_WC = looking_east({0.0, 0.0, 1.0});
  const ColourImage here = camera->capture(X_WC, at_s(5.0), 0);
  const ColourImage gone = camera->capture(X_WC, at_s(0.0), 0);
  const auto box = box_of(world.people.front(), at_s(5.0), X_WC, here.camera);
  ASSERT_TRUE(box.has_value());
  int inside = 0;
  for (int i = 0; i < 64 * 48; ++i) {
    const int x = i % 64;
    const int y = i / 64;
    const auto a = 3 * static_cast<std::size_t>(i);
    if (here.rgb[a] != gone.rgb[a] || here.rgb[a + 1] != gone.rgb[a + 1]) {
      ++inside;
      EXPECT_GE(x + 1, box->x_px - 3);  // Its arms reach beyond the cylinder.
      EXPECT_LE(x, box->x_px + box->width_px + 3);
      EXPECT_GE(y + 1, box->y_px - 1);
      EXPECT_LE(y, box->y_px + box->height_px + 2);
    }
  }
  EXPECT_GT(inside, 0.2 * box->area_px2());
}

TEST_F(SomebodyWalks, and_each_of_two_threads_sees_the_person_where_its_picture_was_taken) {
  const Pose X_WC = looking_east({0.0, 0.0, 1.0});
  constexpr int pictures = 20;
  const auto alone = [&](double t_s) { return camera->capture(X_WC, at_s(t_s), 0).rgb; };
  const std::array<std::vector<std::uint8_t>, 2> expected{alone(4.0), alone(6.0)};
  ASSERT_NE(expected[0], expected[1]);
  std::array<int, 2> right{};
  const auto look = [&](std::size_t i) {
    for (int picture = 0; picture < pictures; ++picture) {
      const MissionTime at = at_s(i == 0 ? 4.0 : 6.0);
      const ColourFrame frame = camera->frame({X_WC, Pose::Identity()}, at, 0);
      right[i] += frame.image.value().rgb == expected[i] ? 1 : 0;
    }
  };
  std::thread other{look, 1};
  look(0);
  other.join();
  EXPECT_EQ(right, (std::array<int, 2>{pictures, pictures}));
}

TEST_F(SomebodyWalks, and_who_lies_is_seen_as_low_as_the_solid_that_depth_cameras_see) {
  Person& person = world.people.front();
  person.walk = {{0.0, {6.0, 0.0, 0.0}}};
  person.lies = true;
  person.radius_m = 0.875;
  person.height_m = 0.31;
  spec.sun_elevation_rad = 1.57;  // No shadow beside the body.
  camera = std::move(*ColourCamera::make(world, spec));
  const Pose X_WC = looking_east({0.0, 0.0, 1.0});
  const ColourImage with = camera->capture(X_WC, at_s(0.0), 0);
  const ColourImage without = (*ColourCamera::make(World{}, spec))->capture(X_WC, at_s(0.0), 0);
  const auto box = box_of(person, at_s(0.0), X_WC, with.camera);
  ASSERT_TRUE(box.has_value());
  int differ = 0;
  for (int i = 0; i < 64 * 48; ++i) {
    if (pixel(with, i % 64, i / 64).red != pixel(without, i % 64, i / 64).red) {
      ++differ;
      EXPECT_GE(i / 64 + 1, box->y_px - 1);
      EXPECT_LE(i / 64, box->y_px + box->height_px + 1);
      EXPECT_GE(i % 64 + 1, box->x_px - 2);  // Its hands reach a decimetre beyond the cylinder.
      EXPECT_LE(i % 64, box->x_px + box->width_px + 2);
    }
  }
  EXPECT_GT(differ, 0.2 * box->area_px2());
}

TEST(ColourCamera, says_what_is_missing_when_there_is_no_mesh_for_a_person) {
  World world;
  world.people.resize(1);
  ColourCameraSpec spec = small_camera();
  spec.people_folder = "/nowhere";
  const auto camera = ColourCamera::make(world, spec);
  ASSERT_FALSE(camera.ok());
  EXPECT_NE(camera.error().message.find("morse-simulator-data"), std::string::npos);
}

TEST(BoxOfAPerson, is_where_the_cylinder_projects) {
  Person person;
  person.walk = {{0.0, {10.0, 0.0, 0.0}}};
  const Intrinsics camera = small_camera().intrinsics();
  const auto box = box_of(person, MissionTime{}, looking_east({0.0, 0.0, 0.875}), camera);
  ASSERT_TRUE(box.has_value());
  EXPECT_NEAR(box->centre_x_px(), 16.0, 1e-9);
  EXPECT_NEAR(box->centre_y_px(), 12.0, 1e-9);
  EXPECT_NEAR(box->height_px, camera.focal_px * 1.75 / 9.7, 0.02);
}

TEST(BoxOfAPerson, is_none_behind_the_camera_or_beside_the_image) {
  Person person;
  const Intrinsics camera = small_camera().intrinsics();
  person.walk = {{0.0, {-10.0, 0.0, 0.0}}};
  EXPECT_FALSE(box_of(person, MissionTime{}, looking_east({0.0, 0.0, 1.0}), camera).has_value());
  person.walk = {{0.0, {10.0, 30.0, 0.0}}};
  EXPECT_FALSE(box_of(person, MissionTime{}, looking_east({0.0, 0.0, 1.0}), camera).has_value());
}

}  // namespace
}  // namespace flyball
