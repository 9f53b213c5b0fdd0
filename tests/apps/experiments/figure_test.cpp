// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/figure.h"

#include "experiments/framework/plots_of.h"
#include "made_sweep.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

const MedianInterval value{2.5, 1.0, 4.0};

TEST(Figure, writes_every_kind_of_plot_as_csv) {
  EXPECT_EQ(to_csv({"f", "c", LinePlot{"time, s", "rate", {"1", "2"}, {{"p", {value, {}}}}}}),
            "line,rate,\"time, s\",lo,hi\np,1,2.5,1.0,4.0\np,2,,,\n");
  EXPECT_EQ(to_csv({"f", "c", DotPlot{"W", {{"rotors, all", value}}}}),
            "name,W,lo,hi\n\"rotors, all\",2.5,1.0,4.0\n");
  HeatMap map{"time", "clock", "cores", {"1"}, {"2", "3"}, {{value, "n 3"}, {{}, "0 of 3"}}};
  EXPECT_EQ(to_csv({"f", "c", map}),
            "cores,clock,flights,time,lo,hi\n2,1,n 3,2.5,1.0,4.0\n3,1,0 of 3,,,\n");
  EXPECT_EQ(to_csv({"f", "c", CellPicture{"t", 0.5, 1.0, 2.0, 1, {PlaceState::free}}}),
            "x_m,y_m,state\n1.25,2.25,free\n");
  EXPECT_EQ(to_csv({"f", "c", TextTable{"t", {{"a", "b"}, {"1", ""}}}}), "a,b\n1,\n");
}

TEST(Figure, stands_in_the_page_with_its_caption_as_text) {
  const std::string html = to_html({"f", "3 flights & <more>", DotPlot{"W", {{"rotors", value}}}});
  EXPECT_NE(html.find("<svg"), std::string::npos);
  EXPECT_NE(html.find("3 flights &amp; &lt;more&gt;"), std::string::npos);
  const std::string table = to_html({"f", "", TextTable{"t", {{"head"}, {"a<b"}}}});
  EXPECT_NE(table.find("<th>head</th>"), std::string::npos);
  EXPECT_NE(table.find("<td>a&lt;b</td>"), std::string::npos);
}

TEST(Figure, draws_a_sweep_over_its_axis_with_readable_labels) {
  const Evidence evidence{{{"made", made_sweep()}}};
  PlotOf wanted{"made", "time, s", flight_figure("mission_time_s")};
  const LinePlot plain = line_plot_of(evidence, wanted);
  EXPECT_EQ(plain.x_title, "a");
  EXPECT_EQ(plain.places, (std::vector<std::string>{"1", "2"}));
  ASSERT_EQ(plain.lines.size(), 1U);
  EXPECT_EQ(plain.lines.front().name, "fixed");
  EXPECT_EQ(plain.lines.front().values[1]->median, 201.5);
  wanted.x = {"amount, kg", {"one", "two"}};
  EXPECT_EQ(line_plot_of(evidence, wanted).x_title, "amount, kg");
  EXPECT_EQ(line_plot_of(evidence, wanted).places[1], "two");
  EXPECT_EQ(counts_text(evidence, wanted).rfind("Each value: 2 flights", 0), 0U);
}

TEST(Figure, draws_a_heat_map_over_two_axes) {
  Sweep sweep = made_sweep();
  sweep.plan.axes = {{"b", {"x", "y"}}, {"a", {"1"}}};
  std::vector<SweepFlight> flights = sweep.flights;
  const Evidence evidence{{{"made", sweep_of(sweep.plan, {"", ""}, std::move(flights))}}};
  const HeatMap map = heat_map_of(evidence, {"made", "time, s", flight_figure("mission_time_s")});
  ASSERT_EQ(map.cells.size(), 2U);
  EXPECT_EQ(map.cells[0].value->median, 101.5);
  EXPECT_EQ(map.cells[0].under, "n 2");
  EXPECT_LE(map.low, 101.5);
  EXPECT_GE(map.high, 201.5);
}

}  // namespace
}  // namespace flyball
