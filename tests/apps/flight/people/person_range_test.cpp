// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/person_range.h"

#include "flyball/sim/gimbal.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double above_m = 4.5;

ColourFrame looking_down(double tilt_rad) {
  ColourFrame frame;
  frame.camera = {384, 288, 400.0, 191.5, 143.5};
  frame.X_LC = camera_in_level_frame({0.0, tilt_rad});
  return frame;
}

double row_of(const ColourFrame& frame, const Vec3& p_L) {
  const Vec3 p_C = frame.X_LC.inverse() * p_L;
  return frame.camera.centre_y_px + frame.camera.focal_px * p_C.y() / p_C.z();
}

/// Of somebody 1.75 m tall, straight ahead.
ImageBox box_at(const ColourFrame& frame, double distance_m) {
  const double top_px = row_of(frame, {distance_m, 0.0, 1.75 - above_m});
  const double bottom_px = row_of(frame, {distance_m, 0.0, -above_m});
  return {179.5, top_px, 24.0, bottom_px - top_px};
}

PersonRange range_of(const ImageBox& box, const ColourFrame& frame) {
  return person_range(box, frame, {1.75, above_m});
}

TEST(PersonRange, is_told_by_the_size_and_by_the_ground_alike) {
  const ColourFrame frame = looking_down(0.4);
  for (const double distance_m : {6.0, 9.0, 12.0}) {
    const PersonRange range = range_of(box_at(frame, distance_m), frame);
    EXPECT_NEAR(range.by_size_m, distance_m, 1e-6);
    ASSERT_TRUE(range.by_ground_m.has_value());
    // The middle of the box is that of two angles' tangents, not quite half the height.
    EXPECT_NEAR(*range.by_ground_m, distance_m, 0.05 * distance_m);
    EXPECT_TRUE(is_plausible(range));
  }
}

TEST(PersonRange, by_the_ground_is_nothing_on_flat_lines_of_sight_and_from_below) {
  const ColourFrame frame = looking_down(0.1);
  EXPECT_FALSE(range_of(box_at(frame, 40.0), frame).by_ground_m.has_value());
  EXPECT_NEAR(range_of(box_at(frame, 40.0), frame).by_size_m, 40.0, 1e-6);
  EXPECT_TRUE(is_plausible(range_of(box_at(frame, 40.0), frame)));
  const ColourFrame steep = looking_down(0.6);
  EXPECT_FALSE(person_range({180, 140, 24, 70}, steep, {1.75, 0.5}).by_ground_m.has_value());
}

TEST(PersonRange, contradicts_itself_for_what_is_too_small_or_too_large_for_its_place) {
  const ColourFrame frame = looking_down(0.4);
  const ImageBox person = box_at(frame, 8.0);
  const auto scaled = [&](double factor) {
    return ImageBox{person.x_px, person.centre_y_px() - 0.5 * factor * person.height_px,
                    person.width_px, factor * person.height_px};
  };
  EXPECT_TRUE(is_plausible(range_of(scaled(0.75), frame)));
  EXPECT_TRUE(is_plausible(range_of(scaled(1.4), frame)));
  EXPECT_FALSE(is_plausible(range_of(scaled(0.5), frame)));
  EXPECT_FALSE(is_plausible(range_of(scaled(2.0), frame)));
}

}  // namespace
}  // namespace flyball
