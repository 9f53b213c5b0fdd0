// SPDX-License-Identifier: BSD-3-Clause
#include "studies/plots/dot_plot.h"

#include "text_count.h"
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// The number behind the last `key` before `mark`; behind the first one without it.
double number_after(const std::string& text, const std::string& key, const std::string& mark = "") {
  const std::size_t at =
      mark.empty() ? text.find(key) : text.rfind(key, text.find(">" + mark + "<"));
  return at == std::string::npos ? -1.0 : std::stod(text.substr(at + key.size()));
}

PlottedPoint point(const std::string& name, double x, double y) {
  return {name, {x, x - 1.0, x + 1.0}, {y, y - 1.0, y + 1.0}};
}

TEST(DotPlot, has_a_dot_for_each_value_there_is) {
  const std::string svg =
      dot_plot_svg("time", {{"a", MedianInterval{3.0, 2.0, 4.0}}, {"b", std::nullopt}});
  EXPECT_EQ(kit::count(svg, "<circle"), 1U);
  EXPECT_EQ(kit::count(svg, "no flight succeeded"), 1U);
}

TEST(DotPlot, puts_a_value_of_zero_at_the_left_end) {
  const std::string svg = dot_plot_svg("hits", {{"a", MedianInterval{0.0, 0.0, 0.0}}});
  EXPECT_NE(svg.find("cx=\"150.0\""), std::string::npos) << svg;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(DotPlot, has_room_for_long_names) {
  const std::string name(40, 'n');
  const std::string svg = dot_plot_svg("time", {{name, MedianInterval{0.0, 0.0, 0.0}}});
  EXPECT_EQ(number_after(svg, "cx=\""), number_after(svg, "text x=\"", name) + 8.0);
  EXPECT_GT(number_after(svg, "cx=\""), 6.0 * 40.0);
}

TEST(ParetoPlot, writes_the_names_of_points_that_lie_on_each_other_in_rows) {
  const std::string svg = pareto_plot_svg(
      "s", "kJ", {point("one", 10, 40), point("two", 10, 40), point("three", 10, 40)});
  std::vector<double> rows;
  for (const char* name : {"one", "two", "three"}) {
    rows.push_back(number_after(svg, "\" y=\"", name));
  }
  std::sort(rows.begin(), rows.end());
  EXPECT_GE(rows[1] - rows[0], 14.0);
  EXPECT_GE(rows[2] - rows[1], 14.0);
}

// Its ticks were added up for ever.
TEST(DotPlot, of_a_value_without_bounds_ends) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const MedianInterval value{endless, 1.0, endless};
  EXPECT_EQ(kit::count(dot_plot_svg("s", {{"one", value}}), "<circle"), 1U);
  EXPECT_EQ(kit::count(pareto_plot_svg("s", "kJ", {{"one", value, value}}), "<circle"), 1U);
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
  EXPECT_EQ(kit::count(svg, "<circle"), 3U);
  EXPECT_EQ(kit::count(svg, "stroke-dasharray"), 1U);
}

TEST(ParetoPlot, has_its_title_above_the_topmost_number) {
  for (const double most : {37.0, 40.0, 45.3, 46.0, 50.0, 92.0}) {
    const std::string svg = pareto_plot_svg("s", "kJ", {point("one", 10, most)});
    const double title_px = number_after(svg, "\" y=\"", "kJ");
    constexpr double letter_px = 12.0;
    std::size_t numbers = 0;
    for (std::size_t at = svg.find("x=\"54.0\" y=\""); at != std::string::npos;
         at = svg.find("x=\"54.0\" y=\"", at + 1)) {
      ++numbers;
      EXPECT_GE(std::stod(svg.substr(at + 12)) - letter_px, title_px) << most;
    }
    EXPECT_GT(numbers, 1U);
  }
}

TEST(ParetoPlot, draws_one_point_without_extent) {
  const PlottedPoint only{"only", {0.0, 0.0, 0.0}, {5.0, 5.0, 5.0}};
  EXPECT_EQ(pareto_plot_svg("s", "kJ", {only}).find("nan"), std::string::npos);
  EXPECT_NE(pareto_plot_svg("s", "kJ", {}).find("No flight succeeded"), std::string::npos);
}

}  // namespace
}  // namespace flyball
