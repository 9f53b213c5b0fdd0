// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/colour_image.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

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

}  // namespace
}  // namespace flyball
