// SPDX-License-Identifier: BSD-3-Clause
#include "visual/patches.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

const CameraModel camera{96, 72, 48.0, 48.0, 47.5, 35.5, {}};

/// A smooth pattern that is shifted by part of a pixel.
std::vector<std::uint8_t> pattern(double shift_x_px, double shift_y_px) {
  std::vector<std::uint8_t> grey;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column) {
      const double x = column - shift_x_px;
      const double y = row - shift_y_px;
      grey.push_back(static_cast<std::uint8_t>(
          std::lround(128.0 + 50.0 * std::sin(0.7 * x + 0.2 * y) + 50.0 * std::sin(0.9 * y))));
    }
  }
  return grey;
}

TEST(Patches, are_followed_to_a_fraction_of_a_pixel) {
  const auto places =
      follow_patches(pattern(0.0, 0.0), pattern(0.6, -0.3), camera, {{{40.0, 30.0}, {40.0, 30.0}}});
  ASSERT_EQ(places.size(), 1U);
  ASSERT_TRUE(places[0]);
  EXPECT_NEAR(places[0]->x(), 40.6, 0.05);
  EXPECT_NEAR(places[0]->y(), 29.7, 0.05);
}

TEST(Patches, are_not_found_where_nothing_is_to_be_seen) {
  const std::vector<std::uint8_t> blank(96U * 72U, 128);
  EXPECT_FALSE(follow_patches(blank, blank, camera, {{{40.0, 30.0}, {40.0, 30.0}}})[0]);
}

TEST(Patches, are_not_believed_far_from_where_they_should_be) {
  const auto places =
      follow_patches(pattern(0.0, 0.0), pattern(4.0, 0.0), camera, {{{40.0, 30.0}, {40.0, 30.0}}});
  EXPECT_FALSE(places[0]);
  EXPECT_TRUE(follow_patches(pattern(0.0, 0.0), pattern(4.0, 0.0), camera,
                             {{{40.0, 30.0}, {44.5, 30.0}}})[0]);
}

TEST(Patches, of_images_that_do_not_exist_are_none) {
  EXPECT_TRUE(follow_patches({}, {}, camera, {}).empty());
}

}  // namespace
}  // namespace flyball
