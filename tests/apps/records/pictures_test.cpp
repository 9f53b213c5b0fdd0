// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/records/pictures.h"

#include "scratch_folder.h"

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

TEST(Pictures, come_back_from_a_file_as_they_were_written) {
  const ScratchFolder folder;
  ColourImage image = plain(7, 5, {10, 20, 30});
  image.rgb[0] = 200;
  const std::string file = folder.file("a.png", *png_of(image));
  const auto reader = open_pictures(file);
  ASSERT_TRUE(reader.ok()) << reader.error().message;
  const auto first = (*reader)->next();
  ASSERT_TRUE(first.ok() && first->has_value());
  EXPECT_EQ((*first)->image.rgb, image.rgb);
  EXPECT_EQ((*first)->image.camera.width_px, 7);
  EXPECT_EQ((*first)->file, file);
  EXPECT_FALSE((*reader)->next()->has_value());
}

TEST(Pictures, of_a_folder_come_in_order_of_name_without_what_is_none) {
  const ScratchFolder folder;
  (void)folder.file("b.png", *png_of(plain(4, 4, {0, 0, 2})));
  (void)folder.file("a.png", *png_of(plain(4, 4, {0, 0, 1})));
  (void)folder.file("readme.txt", "no picture");
  const auto reader = open_pictures(folder.path());
  ASSERT_TRUE(reader.ok()) << reader.error().message;
  EXPECT_EQ((*(*reader)->next())->image.rgb[2], 1);
  EXPECT_EQ((*(*reader)->next())->image.rgb[2], 2);
  EXPECT_FALSE((*reader)->next()->has_value());
}

TEST(Pictures, that_are_none_are_refused) {
  const ScratchFolder folder;
  const auto absent = open_pictures(folder.path("absent.png"));
  ASSERT_FALSE(absent.ok());
  EXPECT_EQ(absent.error().code, ErrorCode::not_found);
  const auto text = open_pictures(folder.file("a.txt", "no picture"));
  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error().code, ErrorCode::invalid_input);
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
