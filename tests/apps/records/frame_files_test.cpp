// SPDX-License-Identifier: BSD-3-Clause
#include "records/frame_files.h"

#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

// The examples of RFC 4648, section 10.
TEST(Base64, of_the_standards_examples) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xfe\xfd"), "//79");
}

TEST(FrameFiles, are_written_beside_the_record_and_shown_in_its_page) {
  const ScratchFolder folder;
  MissionFrame frame{"after 3 s <on the person>", {}};
  frame.image.camera = {4, 3, 0.0, 0.0, 0.0};
  frame.image.rgb.assign(36, 128);
  const auto html = write_frames(folder.path(), {frame, frame});
  ASSERT_TRUE(html.ok()) << html.error().message;
  EXPECT_EQ(folder.content("frame_2.png").substr(1, 3), "PNG");
  EXPECT_NE(html->find(base64_of(folder.content("frame_1.png"))), std::string::npos);
  EXPECT_NE(html->find("&lt;on the person"), std::string::npos);
}

TEST(FrameFiles, show_what_was_right_in_green_and_what_was_not_in_red) {
  ColourImage image;
  image.camera = {8, 8, 0.0, 0.0, 0.0};
  image.rgb.assign(192, 0);
  const MissionFrame right = boxed(image, {1, 1, 6, 6}, true, "right");
  const MissionFrame wrong = boxed(image, {1, 1, 6, 6}, false, "wrong");
  const std::size_t corner = 3 * (8 + 1);
  EXPECT_GT(right.image.rgb[corner + 1], right.image.rgb[corner]);
  EXPECT_GT(wrong.image.rgb[corner], wrong.image.rgb[corner + 1]);
  EXPECT_EQ(right.caption, "right");
}

TEST(FrameFiles, are_none_for_a_mission_without_pictures) {
  const ScratchFolder folder;
  EXPECT_EQ(*write_frames(folder.path(), {}), "");
  EXPECT_TRUE(folder.is_empty());
}

}  // namespace
}  // namespace flyball
