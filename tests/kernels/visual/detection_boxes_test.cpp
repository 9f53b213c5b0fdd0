// SPDX-License-Identifier: BSD-3-Clause
#include "visual/detection_boxes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(DetectionBoxes, keep_the_surest_of_those_that_overlap_and_all_that_stand_apart) {
  const auto kept =
      keep_best({{{0, 0, 10, 20}, 0.5}, {{1, 0, 10, 20}, 0.9}, {{50, 0, 10, 20}, 0.2}}, 0.4);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].score, 0.9);
  EXPECT_EQ(kept[1].box.x_px, 50.0);
}

TEST(DetectionBoxes, leave_out_what_is_no_number) {
  const double nan = std::nan("");
  const auto kept = keep_best({{{0, 0, 10, 20}, nan},
                               {{1, 0, 10, 20}, 0.9},
                               {{1, nan, 10, 20}, 0.95},
                               {{0, 0, 10, HUGE_VAL}, 1.0}},
                              0.4);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].score, 0.9);
}

TEST(DetectionBoxes, of_the_same_score_come_from_the_upper_left) {
  const auto kept =
      keep_best({{{30, 5, 4, 4}, 1.0}, {{9, 5, 4, 4}, 1.0}, {{90, 1, 4, 4}, 1.0}}, 0.4);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0].box.x_px, 90.0);
  EXPECT_EQ(kept[1].box.x_px, 9.0);
}

TEST(DetectorInput, must_be_an_image_of_the_size_that_its_camera_says) {
  ColourImage image;
  EXPECT_FALSE(check_detector_input(image, 1.0).ok());
  image.camera.width_px = 4;
  image.camera.height_px = 3;
  image.rgb.resize(35);
  EXPECT_FALSE(check_detector_input(image, 1.0).ok());
  image.rgb.resize(36);
  EXPECT_TRUE(check_detector_input(image, 1.0).ok());
  for (const double scale : {0.0, -1.0, 9.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(check_detector_input(image, scale).ok()) << scale;
  }
}

}  // namespace
}  // namespace flyball
