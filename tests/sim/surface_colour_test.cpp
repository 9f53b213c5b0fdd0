// SPDX-License-Identifier: BSD-3-Clause
#include "world/surface_colour.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr Material materials[] = {Material::plaster, Material::brick,  Material::wood,
                                  Material::bark,    Material::leaves, Material::grass,
                                  Material::gravel,  Material::asphalt};

/// Difference between the brightest and the darkest of 400 places along a wall.
float contrast(Material material, float footprint_m) {
  float darkest = 1e9F;
  float brightest = 0.0F;
  for (int i = 0; i < 400; ++i) {
    SurfacePoint point;
    point.normal_W = Eigen::Vector3f::UnitX();
    point.p_W = {0.0F, 0.013F * static_cast<float>(i), 0.011F * static_cast<float>(i % 37)};
    point.footprint_m = footprint_m;
    const float green = surface_colour(material, point).y();
    darkest = std::min(darkest, green);
    brightest = std::max(brightest, green);
  }
  return brightest - darkest;
}

TEST(SurfaceColour, of_every_material_shows_a_pattern_that_fades_with_distance) {
  for (const Material material : materials) {
    EXPECT_GT(contrast(material, 0.001F), 0.05F) << static_cast<int>(material);
    EXPECT_LT(contrast(material, 1.0F), 0.5F * contrast(material, 0.001F))
        << static_cast<int>(material);
  }
}

TEST(SurfaceColour, stays_one_that_a_picture_can_show) {
  for (const Material material : materials) {
    for (int i = 0; i < 200; ++i) {
      SurfacePoint point;
      point.p_W = {0.37F * static_cast<float>(i) - 40.0F, 0.73F * static_cast<float>(i), 0.0F};
      const Eigen::Vector3f colour = surface_colour(material, point);
      ASSERT_GE(colour.minCoeff(), 0.0F);
      ASSERT_LE(colour.maxCoeff(), 1.0F);
    }
  }
}

TEST(SkyColour, is_bluer_above_and_brighter_near_the_sun) {
  const Eigen::Vector3f sun{0.8F, 0.0F, 0.6F};
  const Eigen::Vector3f above = sky_colour(Eigen::Vector3f::UnitZ(), sun);
  const Eigen::Vector3f far_off = sky_colour({-0.8F, 0.0F, 0.6F}, sun);
  EXPECT_GT(above.z() - above.x(), 0.2F);
  EXPECT_GT(sky_colour(sun, sun).sum(), far_off.sum());
}

}  // namespace
}  // namespace flyball
