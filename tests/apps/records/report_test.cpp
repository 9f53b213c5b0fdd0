// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/report.h"

#include "made_flights.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

/// What the page's script will read.
nlohmann::json data_of(const std::string& page) {
  const std::string mark = "id=\"data\">";
  const std::size_t begin = page.find(mark) + mark.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(Report, a_picture_has_two_samples_a_second_and_the_end) {
  const auto json = nlohmann::json::parse(picture_of(made_record("a", 1)).json);
  const auto& series = json["series"];
  EXPECT_EQ(series["t"], (std::vector<double>{0.0, 0.5, 1.0, 1.5, 2.0}));
  EXPECT_EQ(series["x"].back(), 10.0);
  EXPECT_EQ(series["y"][0], 0.333) << "rounded to a millimetre";
  for (const auto& [name, values] : series.items()) {
    EXPECT_EQ(values.size(), 5U) << name;
    // Coverage is judged now and then, and only where something is explored.
    EXPECT_EQ(values[0].is_null(), name == "coverage") << name;
  }
}

TEST(Report, the_top_view_shows_what_is_in_the_way_and_no_ceiling) {
  const auto world = nlohmann::json::parse(picture_of(made_record("a", 1)).json)["world"];
  EXPECT_EQ(world["boxes"], nlohmann::json::parse("[[2.0, 1.0, 3.0, 2.0]]"));
  EXPECT_EQ(world["pillars"], nlohmann::json::parse("[[6.0, -2.0, 0.25]]"));
  EXPECT_EQ(world["goal"], nlohmann::json::parse("[10.0, 0.0]"));
}

/// As a flight at this height, after a take-off.
void set_height(MissionRecord& record, double z_m) {
  record.trace = std::make_shared<MemoryRecorder>();
  record.trace->record(
      MissionTime{}, "state",
      {{"x_m", 0.0}, {"y_m", 0.0}, {"z_m", 0.5}, {"phase", std::string{"take_off"}}});
  record.trace->record(
      MissionTime{from_seconds(2.0)}, "state",
      {{"x_m", 1.0}, {"y_m", 0.0}, {"z_m", z_m}, {"phase", std::string{"cruise"}}});
}

TEST(Report, the_top_view_tells_what_is_lower_than_the_flight_from_what_is_in_its_way) {
  MissionRecord record = made_record("a", 1);
  record.world.bounds_W.max.z() = 12.0;  // The vehicle might have flown high or low.
  record.world.boxes = {{Vec3{2, 1, 0}, Vec3{3, 2, 3}}, {Vec3{4, 1, 0}, Vec3{5, 2, 0.005}}};
  set_height(record, 4.5);
  auto world = nlohmann::json::parse(picture_of(record).json)["world"];
  EXPECT_EQ(world["boxes"], nlohmann::json::array());
  EXPECT_EQ(world["low"]["boxes"], nlohmann::json::parse("[[2.0, 1.0, 3.0, 2.0]]"))
      << "a path of gravel is ground";
  EXPECT_EQ(world["low"]["pillars"].size(), 1U);
  set_height(record, 3.2);
  world = nlohmann::json::parse(picture_of(record).json)["world"];
  EXPECT_EQ(world["boxes"].size(), 1U);
  EXPECT_EQ(world["pillars"].size(), 1U);
  EXPECT_EQ(world["low"]["boxes"], nlohmann::json::array());
}

TEST(Report, a_mission_without_a_goal_shows_none) {
  MissionRecord record = made_record("a", 1);
  record.has_goal = false;
  EXPECT_FALSE(nlohmann::json::parse(picture_of(record).json)["world"].contains("goal"));
}

TEST(Report, a_person_has_a_place_at_each_sample) {
  MissionRecord record = made_record("a", 1);
  EXPECT_FALSE(nlohmann::json::parse(picture_of(record).json).contains("people"));
  Person person;
  person.walk = {{0.0, Vec3{1, 2, 0}}, {2.0, Vec3{3, 2, 0}}};
  record.world.people = {person};
  const auto people = nlohmann::json::parse(picture_of(record).json)["people"];
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0]["x"], (std::vector<double>{1.0, 1.5, 2.0, 2.5, 3.0}));
  EXPECT_EQ(people[0]["y"], (std::vector<double>{2.0, 2.0, 2.0, 2.0, 2.0}));
}

TEST(Report, the_map_that_was_made_is_a_raster_of_its_cells_at_flight_height) {
  MissionRecord record = made_record("a", 1);
  EXPECT_FALSE(nlohmann::json::parse(picture_of(record).json).contains("map"));
  record.map = {{Vec3{1.0, 1.0, 1.2}, 0.2}, {Vec3{3.0, 1.0, 2.6}, 0.2}};  // The second: a ceiling.
  const auto raster = nlohmann::json::parse(picture_of(record).json)["map"];
  const double cell_m = raster["cell_m"];
  double filled_m2 = 0.0;
  for (const auto& row : raster["rows"]) {
    for (std::size_t i = 1; i < row.size(); i += 2) {
      filled_m2 += row[i].get<double>() * cell_m * cell_m;
      EXPECT_NEAR(raster["x_m"].get<double>() + row[i - 1].get<double>() * cell_m, 0.9, cell_m);
    }
  }
  EXPECT_GE(filled_m2, 0.04 - 1e-9);
  EXPECT_LE(filled_m2, (0.2 + 2 * cell_m) * (0.2 + 2 * cell_m));
}

TEST(Report, a_picture_of_a_survey_has_the_area_and_each_footprint_with_its_time) {
  MissionRecord record = made_record("a", 1);
  EXPECT_FALSE(nlohmann::json::parse(picture_of(record).json).contains("footprint"));
  record.trace->record(MissionTime{}, "area",
                       {{"x0_m", 0.0}, {"y0_m", 0.0}, {"x1_m", 9.0}, {"y1_m", 4.0}});
  record.trace->record(MissionTime{from_seconds(1.5)}, "footprint",
                       {{"x0_m", 1.0}, {"y0_m", 2.0}, {"x1_m", 3.0}, {"y1_m", 4.0}});
  const auto json = nlohmann::json::parse(picture_of(record).json);
  EXPECT_EQ(json["area"][0], nlohmann::json::parse("[0.0, 0.0, 9.0, 4.0, 0.0]"));
  ASSERT_EQ(json["footprint"].size(), 1U);
  EXPECT_EQ(json["footprint"][0], nlohmann::json::parse("[1.0, 2.0, 3.0, 4.0, 1.5]"));
}

TEST(Report, very_many_boxes_become_a_raster_of_the_same_area) {
  MissionRecord record = made_record("a", 1);
  record.world.boxes.clear();
  for (int i = 0; i < 6000; ++i) {  // A wall from x = 0 to 6, 1 m thick.
    record.world.boxes.push_back({Vec3{i * 1e-3, 0, 0}, Vec3{(i + 1) * 1e-3, 1, 3}});
  }
  const auto world = nlohmann::json::parse(picture_of(record).json)["world"];
  EXPECT_FALSE(world.contains("boxes"));
  const double cell_m = world["raster"]["cell_m"];
  double filled = 0.0;
  for (const auto& row : world["raster"]["rows"]) {
    for (std::size_t i = 1; i < row.size(); i += 2) {
      filled += row[i].get<double>();
    }
  }
  EXPECT_NEAR(filled * cell_m * cell_m, 6.0, 2.0 * 7.0 * cell_m)
      << "a cell on each side of the rim";
}

TEST(Report, a_field_that_a_flight_does_not_have_is_null) {
  MissionRecord record = made_record("a", 1);
  record.trace = std::make_shared<MemoryRecorder>();
  record.trace->record(MissionTime{}, "state", {{"x_m", 1.0}});
  const auto series = nlohmann::json::parse(picture_of(record).json)["series"];
  EXPECT_TRUE(series["limit"][0].is_null());
}

TEST(Report, the_page_stands_alone_and_holds_each_world_once) {
  const std::vector<RunPicture> runs{picture_of(made_record("a", 1)),
                                     picture_of(made_record("b", 1))};
  const std::string page = report_page("title", runs, "<table></table>");
  for (const char* outside : {"http://", "https://", "src=", "<link", "@import", "{{"}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  for (const char* part : {"function drawMap", "function knobRows", "function drawChart"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  const auto data = data_of(page);
  EXPECT_EQ(data["worlds"].size(), 1U);
  ASSERT_EQ(data["runs"].size(), 2U);
  EXPECT_EQ(data["runs"][1]["world"], 0);
  EXPECT_EQ(data["runs"][1]["policy"], "b");
}

TEST(Report, names_cannot_break_out_of_the_script) {
  const std::string page =
      report_page("</title>{{data}}", {picture_of(made_record("</script><b>", 1))}, "");
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_EQ(data_of(page)["runs"][0]["policy"], "</script><b>");
  EXPECT_NE(page.find("&lt;/title&gt;{{data}}"), std::string::npos)
      << "a mark in a name is only a name";
}

}  // namespace
}  // namespace flyball
