// SPDX-License-Identifier: BSD-3-Clause

#include "studies/plots/heat_map.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

HeatMap made_map() {
  HeatMap map{"energy, kJ", "range", "cells", {"5", "10"}, {"0.15", "0.3"}, {}, 10.0, 40.0};
  map.cells = {{MedianInterval{10.0, 9.0, 11.0}, "n 3"},
               {MedianInterval{20.0, 19.0, 21.0}, "n 3"},
               {MedianInterval{40.0, 40.0, 40.0}, "1 of 3 fly"},
               {std::nullopt, "0 of 3 fly"}};
  return map;
}

std::string fill_before(const std::string& svg, const std::string& mark) {
  const std::size_t at = svg.rfind("fill=\"", svg.find(mark));
  return svg.substr(at + 6, svg.find('"', at + 6) - at - 6);
}

TEST(HeatMap, says_each_value_with_its_interval_and_how_many_flights_there_are) {
  const std::string svg = heat_map_svg(made_map());
  for (const char* text : {">10.0<", ">[9.0, 11.0]<", ">n 3<", ">1 of 3 fly<", ">none<",
                           ">0 of 3 fly<", ">range<", ">cells<", ">0.15<", ">energy, kJ<"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text << " is not in\n" << svg;
  }
  EXPECT_EQ(svg.find("[40.0, 40.0]"), std::string::npos) << "a single flight has no interval";
}

TEST(HeatMap, colours_the_least_and_the_greatest_with_the_ends_of_the_scale) {
  const std::string svg = heat_map_svg(made_map());
  EXPECT_EQ(fill_before(svg, "energy, kJ: 10.00"), "rgb(253,231,37)");
  EXPECT_EQ(fill_before(svg, "energy, kJ: 40.00"), "rgb(68,1,84)");
  HeatMap wider = made_map();
  wider.high = 80.0;
  EXPECT_EQ(fill_before(heat_map_svg(wider), "energy, kJ: 40.00"), "rgb(50,161,128)")
      << "3/7 of the way";
}

TEST(HeatMap, shows_cells_that_are_all_the_same) {
  HeatMap map = made_map();
  map.low = map.high = 10.0;
  EXPECT_EQ(heat_map_svg(map).find("nan"), std::string::npos);
}

TEST(HeatMap, needs_no_more_digits_than_tell_values_apart) {
  EXPECT_EQ(digits_for(0.0, 500.0), 0);
  EXPECT_EQ(digits_for(10.0, 40.0), 1);
  EXPECT_EQ(digits_for(1.0, 2.0), 3);
  EXPECT_EQ(digits_for(0.0, 0.0), 0);
  EXPECT_EQ(digits_for(3.0, 3.0), 2);
  EXPECT_EQ(digits_for(153.0, 153.2), 1) << "four digits that count";
  EXPECT_EQ(digits_for(0.81107, 0.81109), 4);
  EXPECT_EQ(digits_for(12345.0, 12346.0), 0);
}

}  // namespace
}  // namespace flyball
