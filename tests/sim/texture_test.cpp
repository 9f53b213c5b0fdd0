// SPDX-License-Identifier: BSD-3-Clause
#include "world/texture.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Left half black, right half white.
Texture halves(int size) {
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < size * size; ++i) {
    rgb.insert(rgb.end(), 3, i % size < size / 2 ? std::uint8_t{0} : std::uint8_t{255});
  }
  return {size, size, std::move(rgb)};
}

TEST(Texture, of_one_colour_has_it_everywhere) {
  const Texture red{Eigen::Vector3f{1.0F, 0.0F, 0.2F}};
  EXPECT_TRUE(red.at({0.3F, 7.9F}, 2.0F).isApprox(Eigen::Vector3f(1.0F, 0.0F, 0.2F), 1e-6F));
}

TEST(Texture, shows_its_picture_and_repeats_beside_it) {
  const Texture picture = halves(16);
  EXPECT_NEAR(picture.at({0.25F, 0.5F}, 0.0F).x(), 0.0F, 1e-6F);
  EXPECT_NEAR(picture.at({0.75F, 0.5F}, 0.0F).x(), 1.0F, 1e-6F);
  EXPECT_NEAR(picture.at({-0.25F, 3.5F}, 0.0F).x(), 1.0F, 1e-6F);
}

TEST(Texture, has_its_first_row_at_the_top) {
  const Texture rows{1, 2, {255, 255, 255, 0, 0, 0}};
  EXPECT_NEAR(rows.at({0.5F, 0.75F}, 0.0F).x(), 1.0F, 1e-6F);
  EXPECT_NEAR(rows.at({0.5F, 0.25F}, 0.0F).x(), 0.0F, 1e-6F);
}

TEST(Texture, seen_from_far_away_is_its_mean) {
  EXPECT_NEAR(halves(16).at({0.25F, 0.5F}, 4.0F).x(), 0.5F, 0.01F);
}

TEST(Texture, is_not_made_of_bytes_that_are_no_picture) {
  const char text[] = "no picture at all";
  const auto made = Texture::from_png(text, sizeof text);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace flyball
