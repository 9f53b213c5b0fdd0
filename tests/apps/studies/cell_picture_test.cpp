// SPDX-License-Identifier: BSD-3-Clause

#include "studies/plots/cell_picture.h"

#include "text_count.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(CellPicture, draws_neighbours_that_are_alike_as_one_rectangle) {
  CellPicture picture{"a door", 0.5, 10.0, -1.0, 4, {}};
  picture.squares = {PlaceState::occupied, PlaceState::occupied, PlaceState::passable,
                     PlaceState::occupied,
                     // The upper row.
                     PlaceState::free, PlaceState::free, PlaceState::free, PlaceState::unknown};
  ASSERT_EQ(picture.rows(), 2U);
  const std::string svg = cell_picture_svg(picture);
  constexpr std::size_t in_legend = 4;
  EXPECT_EQ(kit::count(svg, "<rect"), 5 + in_legend) << svg;
  EXPECT_LT(svg.find("#f3f5f7"), svg.rfind("#f3f5f7")) << "once in the map, once in the legend";
}

TEST(CellPicture, says_what_its_colours_mean_and_where_it_is) {
  const std::string svg =
      cell_picture_svg({"a door", 1.0, 10.0, -1.0, 2, std::vector<PlaceState>(4)});
  for (const char* text : {">a door<", ">unknown<", ">the body fits<", ">occupied<", ">10.0<"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text << " is not in\n" << svg;
  }
}

}  // namespace
}  // namespace flyball
