// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/records/place_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// 4 x 2 m of free cells of .1 m with one solid cell in column 10, row 5, and unknown at the right.
PlacePlan made_plan() {
  PlacePlan plan{{Vec3{-1, 0, 0}, Vec3{3, 2, 3}}, 0.1, 40, 20, {}};
  plan.cells.assign(800, CellState::free);
  plan.cells[5 * 40 + 10] = CellState::occupied;
  for (std::size_t row = 0; row < 20; ++row) {
    plan.cells[row * 40 + 39] = CellState::unknown;
  }
  return plan;
}

TEST(PlacePicture, gives_room_only_where_a_body_fits) {
  const PlacePlan plan = made_plan();
  const auto room = cells_with_room(plan);
  for (int row = 0; row < plan.rows; ++row) {
    for (int column = 0; column < 39; ++column) {
      const double dx = std::max(0.0, std::abs(column - 10) - 0.5) * 0.1;
      const double dy = std::max(0.0, std::abs(row - 5) - 0.5) * 0.1;
      EXPECT_EQ(room[static_cast<std::size_t>(row * 40 + column)], dx * dx + dy * dy > 0.09)
          << column << " " << row;
    }
    EXPECT_FALSE(room[static_cast<std::size_t>(row * 40 + 39)]) << "nobody has looked there";
  }
}

TEST(PlacePicture, has_the_least_x_and_y_in_its_lower_left) {
  PlacePlan plan = made_plan();
  plan.cells[0] = CellState::occupied;
  const ColourImage image = picture_of(plan);
  const int width = image.camera.width_px;
  const auto red = [&](int x, int y) {
    return int{image.rgb[3 * static_cast<std::size_t>(y * width + x)]};
  };
  const int bottom = 20 * 12 - 1;  // Cells are 12 pixels wide.
  ASSERT_EQ(width, 64 + 40 * 12);
  EXPECT_EQ(red(64 + 6, bottom - 7), 34);
  EXPECT_NE(red(64 + 6, 7), 34);
  EXPECT_EQ(red(64 + 10 * 12 + 6, bottom - 5 * 12 - 7), 34);
}

TEST(PlacePicture, of_a_place_with_more_cells_than_pixels_loses_no_solid_one) {
  PlacePlan plan{{Vec3{0, 0, 0}, Vec3{900, 1, 3}}, 0.1, 9000, 10, {}};
  plan.cells.assign(90'000, CellState::free);
  plan.cells[4 * 9000 + 4444] = CellState::occupied;
  const ColourImage image = picture_of(plan);
  EXPECT_LE(image.camera.width_px, 4064);
  const std::array<std::uint8_t, 3> solid{34, 48, 60};
  const auto height = static_cast<std::ptrdiff_t>(4);  // 10 rows, three in a pixel.
  const auto end = image.rgb.begin() + 3 * image.camera.width_px * height;
  EXPECT_NE(std::search(image.rgb.begin(), end, solid.begin(), solid.end()), end);
}

}  // namespace
}  // namespace flyball
