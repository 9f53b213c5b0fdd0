// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/colour_image.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

ColourImage plain(int width_px, int height_px, const Rgb& colour) {
  ColourImage image;
  image.camera = {width_px, height_px, 0.0, 0.0, 0.0};
  for (int i = 0; i < width_px * height_px; ++i) {
    image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
  }
  return image;
}

Rgb pixel(const ColourImage& image, int x, int y) {
  const auto i = 3 * static_cast<std::size_t>(y * image.camera.width_px + x);
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

TEST(ImageBoxes, overlap_by_what_they_share_over_what_they_cover) {
  const ImageBox box{10.0, 20.0, 4.0, 2.0};
  EXPECT_DOUBLE_EQ(overlap(box, box), 1.0);
  EXPECT_DOUBLE_EQ(overlap(box, {12.0, 20.0, 4.0, 2.0}), 4.0 / 12.0);
  EXPECT_DOUBLE_EQ(overlap({12.0, 20.0, 4.0, 2.0}, box), 4.0 / 12.0);
}

TEST(ImageBoxes, that_only_touch_or_have_no_area_do_not_overlap) {
  const ImageBox box{10.0, 20.0, 4.0, 2.0};
  EXPECT_EQ(overlap(box, {14.0, 20.0, 4.0, 2.0}), 0.0);
  EXPECT_EQ(overlap(box, {10.0, 30.0, 4.0, 2.0}), 0.0);
  EXPECT_EQ(overlap({}, {}), 0.0);
}

TEST(PixelRegions, cover_what_lies_inside_and_nothing_that_sticks_out) {
  const PixelRegion region{10, 20, 4, 3};
  EXPECT_TRUE(region.covers(region));
  EXPECT_TRUE(region.covers({11, 21, 1, 1}));
  EXPECT_FALSE(region.covers({9, 20, 4, 3}));
  EXPECT_FALSE(region.covers({10, 20, 5, 3}));
  EXPECT_FALSE(region.covers({10, 21, 4, 3}));
  EXPECT_TRUE(region.covers({500, 500, 0, 3})) << "nothing is everywhere";
}

TEST(PixelRegions, of_a_box_are_the_pixels_that_it_touches_inside_the_image) {
  const Intrinsics camera{100, 80, 50.0, 49.5, 39.5};
  const PixelRegion inside = pixels_of({10.4, 20.0, 3.0, 2.0}, camera);
  EXPECT_EQ(inside.x_px, 10);
  EXPECT_EQ(inside.width_px, 4) << "from 10.4 to 13.4";
  EXPECT_EQ(inside.y_px, 20);
  EXPECT_EQ(inside.height_px, 2);
  const PixelRegion corner = pixels_of({-1e12, 70.0, 2e12, 1e12}, camera);
  EXPECT_TRUE(corner.covers({0, 70, 100, 10}));
  EXPECT_TRUE(whole(camera).covers(corner));
  EXPECT_TRUE(pixels_of({120.0, 10.0, 5.0, 5.0}, camera).is_empty());
}

TEST(ColourPatch, holds_the_regions_pixels_row_by_row) {
  ColourImage image;
  image.sequence = 9;
  image.camera = {4, 3, 1.0, 1.5, 1.0};
  for (std::uint8_t i = 0; i < 12; ++i) {
    image.rgb.insert(image.rgb.end(), {i, i, static_cast<std::uint8_t>(100 + i)});
  }
  const ColourPatch patch = cut(image, {1, 1, 2, 2});
  EXPECT_EQ(patch.sequence, 9U);
  EXPECT_EQ(patch.camera.width_px, 4);
  EXPECT_EQ(patch.rgb, (std::vector<std::uint8_t>{5, 5, 105, 6, 6, 106, 9, 9, 109, 10, 10, 110}));
  EXPECT_TRUE(cut(image, {}).rgb.empty());
}

TEST(Boxes, are_drawn_as_edges_two_pixels_wide) {
  ColourImage image = plain(20, 20, {0, 0, 0});
  const Rgb red{255, 0, 0};
  draw_box(image, {4, 5, 10, 8}, red);
  EXPECT_EQ(pixel(image, 4, 5), red);
  EXPECT_EQ(pixel(image, 5, 9), red);
  EXPECT_EQ(pixel(image, 13, 12), red);
  EXPECT_EQ(pixel(image, 8, 8), (Rgb{0, 0, 0}));
  EXPECT_EQ(pixel(image, 14, 9), (Rgb{0, 0, 0}));
}

TEST(Boxes, that_reach_out_of_the_image_are_drawn_as_far_as_it_goes) {
  ColourImage image = plain(8, 8, {0, 0, 0});
  draw_box(image, {-5, -5, 10, 10}, {9, 9, 9});
  EXPECT_EQ(pixel(image, 4, 0), (Rgb{9, 9, 9}));
  EXPECT_EQ(pixel(image, 0, 0), (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace flyball
