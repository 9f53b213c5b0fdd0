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

}  // namespace
}  // namespace flyball
