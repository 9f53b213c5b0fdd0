// SPDX-License-Identifier: BSD-3-Clause
#include "dot_plot.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

PlottedPoint point(const std::string& name, double x, double y) {
  return {name, {x, x - 1.0, x + 1.0}, {y, y - 1.0, y + 1.0}};
}

TEST(DotPlot, has_a_dot_for_each_value_there_is) {
  const std::string svg =
      dot_plot_svg("time", {{"a", MedianInterval{3.0, 2.0, 4.0}}, {"b", std::nullopt}});
  EXPECT_EQ(count(svg, "<circle"), 1U);
  EXPECT_EQ(count(svg, "no flight succeeded"), 1U);
}

TEST(DotPlot, puts_a_value_of_zero_at_the_left_end) {
  const std::string svg = dot_plot_svg("hits", {{"a", MedianInterval{0.0, 0.0, 0.0}}});
  EXPECT_NE(svg.find("cx=\"150.0\""), std::string::npos) << svg;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(ParetoPlot, marks_what_nothing_beats_in_both) {
  std::vector<PlottedPoint> points{point("quick", 10, 40), point("thrifty", 20, 20),
                                   point("beaten", 21, 20), point("worst", 30, 50)};
  mark_best(points);
  EXPECT_TRUE(points[0].is_best && points[1].is_best);
  EXPECT_FALSE(points[2].is_best || points[3].is_best);
}

TEST(ParetoPlot, joins_the_best_and_draws_each_point_once) {
  const std::string svg = pareto_plot_svg(
      "s", "kJ", {point("quick", 10, 40), point("thrifty", 20, 20), point("worst", 30, 50)});
  EXPECT_EQ(count(svg, "<circle"), 3U);
  EXPECT_EQ(count(svg, "stroke-dasharray"), 1U);
}

TEST(ParetoPlot, draws_one_point_without_extent) {
  const PlottedPoint only{"only", {0.0, 0.0, 0.0}, {5.0, 5.0, 5.0}};
  EXPECT_EQ(pareto_plot_svg("s", "kJ", {only}).find("nan"), std::string::npos);
  EXPECT_NE(pareto_plot_svg("s", "kJ", {}).find("No flight succeeded"), std::string::npos);
}

}  // namespace
}  // namespace flyball
