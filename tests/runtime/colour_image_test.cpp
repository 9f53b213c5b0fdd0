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

}  // namespace
}  // namespace flyball
