// SPDX-License-Identifier: BSD-3-Clause

#include "studies/plots/line_plot.h"

#include "text_count.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

LinePlot made_plot(const std::vector<std::string>& places) {
  return {"time, s",
          "range",
          places,
          {{"a", {MedianInterval{3.0, 2.0, 4.0}, MedianInterval{5.0, 4.0, 6.0}, std::nullopt}},
           {"b", {std::nullopt, MedianInterval{7.0, 7.0, 7.0}, MedianInterval{9.0, 8.0, 9.5}}}}};
}

/// The x of the place that is named so; -1 where none is.
double place_of(const std::string& svg, const std::string& name) {
  const std::size_t found = svg.find("text-anchor=\"middle\" >" + name + "<");
  return found == std::string::npos ? -1.0
                                    : std::stod(svg.substr(svg.rfind("<text x=\"", found) + 9));
}

TEST(LinePlot, puts_numbers_where_they_belong) {
  const std::string svg = line_plot_svg(made_plot({"110", "120", "200"}));
  const double near = place_of(svg, "120") - place_of(svg, "110");
  const double far = place_of(svg, "200") - place_of(svg, "120");
  EXPECT_NEAR(far / near, 8.0, 0.1);
}

TEST(LinePlot, puts_names_in_a_row) {
  for (const std::vector<std::string>& places :
       {std::vector<std::string>{"low", "middle", "high"}, {"1", "2", "many"}, {"1", "1.0", "2"}}) {
    const std::string svg = line_plot_svg(made_plot(places));
    const double near = place_of(svg, places[1]) - place_of(svg, places[0]);
    EXPECT_NEAR(place_of(svg, places[2]) - place_of(svg, places[1]), near, 0.2) << places[2];
    EXPECT_GT(near, 50.0);
  }
}

TEST(LinePlot, leaves_names_out_where_they_would_overlap) {
  const std::string svg = line_plot_svg(made_plot({"3.98", "0.20", "0.15"}));
  EXPECT_GT(place_of(svg, "0.20"), 0.0);
  EXPECT_EQ(place_of(svg, "0.15"), -1.0);
  EXPECT_GT(place_of(svg, "3.98"), 0.0);
}

TEST(LinePlot, has_some_numbers_on_the_axis_whatever_it_spans) {
  for (const double most : {1.3, 1.9, 2.6, 3.4, 4.9, 7.2, 8.83, 13.0}) {
    LinePlot plot = made_plot({"1", "2", "3"});
    plot.lines.pop_back();
    plot.lines[0].values = {MedianInterval{0.1, 0.1, 0.1}, MedianInterval{most, most, most}, {}};
    const std::size_t numbers = kit::count(line_plot_svg(plot), "text-anchor=\"end\"") - 1;
    EXPECT_GE(numbers, 2U) << most << ", beside the title of the other axis";
    EXPECT_LE(numbers, 7U) << most;
  }
}

TEST(LinePlot, shows_shares_between_none_and_all) {
  LinePlot plot = made_plot({"1", "2", "3"});
  plot.is_percentage = true;
  for (PlottedLine& line : plot.lines) {
    line.values.assign(3, MedianInterval{100.0, 100.0, 100.0});
  }
  const std::string svg = line_plot_svg(plot);
  EXPECT_EQ(kit::count(svg, ">0</text>"), 1U) << svg;
  EXPECT_EQ(kit::count(svg, ">100</text>"), 1U) << svg;
}

TEST(LinePlot, leaves_a_gap_where_nothing_is_known) {
  const std::string svg = line_plot_svg(made_plot({"1", "2", "3"}));
  EXPECT_EQ(kit::count(svg, "stroke-width=\"1.5\""), 2U) << "from 1 to 2 for a, from 2 to 3 for b";
  EXPECT_EQ(kit::count(svg, "stroke-width=\"2.5\""), 4U);
  EXPECT_EQ(kit::count(svg, ">a</text>"), 1U) << "in the legend";
}

TEST(LinePlot, needs_no_legend_for_one_line) {
  LinePlot plot = made_plot({"1", "2", "3"});
  plot.lines.pop_back();
  EXPECT_EQ(kit::count(line_plot_svg(plot), "<circle"), 2U);
  plot.lines[0].values = {std::nullopt, std::nullopt, std::nullopt};
  EXPECT_EQ(line_plot_svg(plot).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace flyball
