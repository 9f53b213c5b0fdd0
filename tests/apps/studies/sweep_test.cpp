// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/sweep.h"

#include "made_flights.h"
#include "text_count.h"
#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

SweepAxis axis_of(const std::string& text) {
  Result<SweepAxis> axis = read_axis(text);
  EXPECT_TRUE(axis.ok()) << text << ": " << axis.error().message;
  return axis ? *axis : SweepAxis{};
}

TEST(Sweep, reads_a_setting_and_its_values) {
  const SweepAxis range = axis_of("map.range_m=5,10.5,20");
  EXPECT_EQ(range.key, "map.range_m");
  EXPECT_EQ(range.values, (std::vector<std::string>{"5", "10.5", "20"}));
  EXPECT_EQ(axis_of("knobs.map.range_m=[5, 10],[7]").values,
            (std::vector<std::string>{"[5, 10]", "[7]"}));
  EXPECT_EQ(axis_of(R"(name="a,b",'c,"d')").values,
            (std::vector<std::string>{R"("a,b")", R"('c,"d')"}));
  EXPECT_EQ(axis_of("kernels.mapper=octomap").values.size(), 1U);
  const SweepAxis spaced = axis_of(" map.range_m = 5, 10.5 ");
  EXPECT_EQ(spaced.key, "map.range_m");
  EXPECT_EQ(spaced.values, (std::vector<std::string>{"5", "10.5"}));
}

TEST(Sweep, refuses_what_names_no_values) {
  for (const char* text :
       {"", "=1,2", "map.range_m", "map.range_m=", "map.range_m=1,,2", "map.range_m=1,2,",
        "map.range_m=1,2,1", "map.range_m=1, 1", "map.range_m=15,15.0", "map.range_m=0.5,5e-1",
        "map.range_m=1, ", " =1"}) {
    const auto axis = read_axis(text);
    ASSERT_FALSE(axis) << text;
    EXPECT_EQ(axis.error().code, ErrorCode::invalid_input);
    EXPECT_NE(axis.error().message.find("--over"), std::string::npos);
    EXPECT_NE(axis.error().message.find("give for example"), std::string::npos);
  }
}

TEST(Sweep, has_every_combination_once_and_turns_the_last_setting_fastest) {
  const std::vector<SweepAxis> axes{{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}};
  const std::vector<SweepPoint> points = points_of(axes, {"p", "q"});
  std::string all;
  for (const SweepPoint& point : points) {
    all += point.policy + ":" + point.settings(axes) + ";";
  }
  EXPECT_EQ(all,
            "p:a=1 b=x;p:a=1 b=y;p:a=1 b=z;p:a=2 b=x;p:a=2 b=y;p:a=2 b=z;"
            "q:a=1 b=x;q:a=1 b=y;q:a=1 b=z;q:a=2 b=x;q:a=2 b=y;q:a=2 b=z;");
}

/// Two values of `a` by two of `b` for one policy, two seeds each. The last cell's flights fail.
Sweep made_sweep(std::vector<SweepAxis> axes = {{"a", {"1", "2"}}, {"b,c", {"\"x\"", "y"}}}) {
  const SweepPlan plan{"made", std::move(axes), {"fixed"}, {1, 2}};
  const std::size_t points = points_of(plan.axes, plan.policies).size();
  std::vector<SweepFlight> flights;
  std::vector<std::string> commands;
  for (std::size_t point = 0; point < points; ++point) {
    commands.push_back("compare " + std::to_string(point));
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      Summary summary = made_summary("fixed", seed);
      summary.mission_time_s = 100.0 * static_cast<double>(point + 1) + static_cast<double>(seed);
      if (point == points - 1) {
        summary.status = MissionStatus::failed;
        summary.failure = MissionFailure::collision;
      }
      flights.push_back({point, "run " + std::to_string(flights.size()), summary});
    }
  }
  return sweep_of(plan, commands, flights);
}

TEST(Sweep, names_a_policy_that_was_replaced) {
  const std::string sentence = "policy fixed was replaced by safe settings in 80 of 3200 decisions";
  EXPECT_NE(to_text(made_sweep()).find(sentence), std::string::npos) << to_text(made_sweep());
  EXPECT_NE(sweep_page(made_sweep()).find(sentence), std::string::npos);
  Sweep sound = made_sweep();
  for (SweepFlight& flight : sound.flights) {
    flight.summary.policy_faults = 0;
  }
  EXPECT_TRUE(troubles_of(sound).empty());
}

TEST(Sweep, a_cell_has_the_medians_of_the_flights_that_succeed) {
  const Sweep sweep = made_sweep();
  ASSERT_EQ(sweep.cells.size(), 4U);
  ASSERT_EQ(sweep.figures.front(), "mission_time_s");
  EXPECT_DOUBLE_EQ(sweep.cells[1].figures.front()->median, 201.5);
  EXPECT_DOUBLE_EQ(sweep.cells[1].figures.front()->lo, 201.0);
  EXPECT_DOUBLE_EQ(sweep.cells[1].figures.front()->hi, 202.0);
  EXPECT_EQ(sweep.cells[1].succeeded, 2);
  EXPECT_EQ(sweep.cells[3].succeeded, 0);
  EXPECT_EQ(sweep.cells[3].failures.at("collision"), 2);
  EXPECT_FALSE(sweep.cells[3].figures.front());
  for (const char* name :
       {"replans", "hover_time_s", "kernel.octomap.mean_ms", "quality.area_covered_percent"}) {
    EXPECT_EQ(std::count(sweep.figures.begin(), sweep.figures.end(), name), 1) << name;
  }
}

TEST(Sweep, its_tables_have_a_row_for_each_cell_and_each_flight) {
  const Sweep sweep = made_sweep();
  const std::string text = to_text(sweep);
  EXPECT_NE(text.find("made, seeds 1, 2"), std::string::npos);
  EXPECT_NE(text.find("201.5 [201.0, 202.0]"), std::string::npos) << text;
  EXPECT_NE(text.find("2 collision"), std::string::npos);
  const std::string cells = cells_csv(sweep);
  EXPECT_EQ(kit::count(cells, "\n"), 5U);
  EXPECT_EQ(cells.rfind("policy,a,\"b,c\",n,succeeded,failures,command,mission_time_s,", 0), 0U);
  EXPECT_NE(cells.find("\nfixed,1,\"\"\"x\"\"\",2,2,,compare 0,101.5,101.0,102.0,"),
            std::string::npos)
      << cells;
  const std::string flights = flights_csv(sweep);
  EXPECT_EQ(kit::count(flights, "\n"), 9U);
  EXPECT_NE(flights.find("\nfixed,2,y,2,failed,collision,0123456789abcdef,run 7,402.0,"),
            std::string::npos)
      << flights;
  const auto json = nlohmann::json::parse(to_json(sweep));
  EXPECT_EQ(json["cells"][0]["figures"]["mission_time_s"]["median"], 101.5);
  EXPECT_TRUE(json["cells"][3]["figures"]["mission_time_s"].is_null());
  EXPECT_EQ(json["over"][1]["values"][1], "y");
}

TEST(Sweep, its_page_draws_what_differs_and_names_every_command) {
  const Sweep sweep = made_sweep();
  const std::string page = sweep_page(sweep);
  EXPECT_EQ(kit::count(page, "<svg"), 2U)
      << "success and mission time; the rest is the same everywhere";
  EXPECT_NE(page.find("mission_time_s: fixed"), std::string::npos);
  EXPECT_NE(page.find("same in every cell"), std::string::npos);
  EXPECT_NE(page.find("replans 7"), std::string::npos);
  for (const SweepCell& cell : sweep.cells) {
    EXPECT_NE(page.find("<code>" + cell.command + "</code>"), std::string::npos);
  }
  EXPECT_EQ(page.find("http"), std::string::npos) << "it needs no network";
}

TEST(Sweep, draws_lines_over_one_setting_and_a_map_for_each_value_of_a_third) {
  const std::string lines = sweep_page(made_sweep({{"a", {"1", "5", "9"}}}));
  EXPECT_EQ(kit::count(lines, "<svg"), 2U);
  EXPECT_EQ(kit::count(lines, "<rect"), 0U);
  const std::string maps =
      sweep_page(made_sweep({{"a", {"1", "2", "3"}}, {"b", {"1", "2"}}, {"c", {"1", "2"}}}));
  EXPECT_EQ(kit::count(maps, "<svg"), 6U) << "two figures for three values of a";
  EXPECT_NE(maps.find("mission_time_s: fixed, a=3"), std::string::npos);
}

}  // namespace
}  // namespace flyball
