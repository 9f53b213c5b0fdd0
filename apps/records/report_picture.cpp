// SPDX-License-Identifier: BSD-3-Clause
// tested-in: report

#include "flyball/records/report.h"

#include "records/knob_history.h"
#include "records/report_world.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t rows_per_sample = 5;  // `state` has 10 rows a second; the page needs 2.

/// The page's name of a series and the trace's name of its field.
struct Series {
  const char* name;
  std::string_view field;
};

constexpr std::array<Series, 8> series_of_state{{
    {"x", "x_m"},
    {"y", "y_m"},
    {"speed", "speed_m_s"},
    {"limit", "set_speed_m_s"},
    {"latency", "latency_bound_s"},
    {"rotor", "rotor_w"},
    {"computer", "computer_w"},
    {"battery", "battery_percent"},
}};

// What is so far below or above the vehicle's centre counts as being at its height.
constexpr double below_m = 0.3;
constexpr double above_m = 0.5;

bool is_cruising(const std::vector<Field>& fields) {
  return std::any_of(fields.begin(), fields.end(), [](const Field& field) {
    const std::string* text = std::get_if<std::string>(&field.value);
    return field.name == "phase" && text != nullptr && *text == "cruise";
  });
}

Json value_of(const std::vector<Field>& fields, std::string_view name) {
  for (const Field& field : fields) {
    if (field.name != name) {
      continue;
    }
    if (const double* number = std::get_if<double>(&field.value)) {
      return json_number(*number);
    }
  }
  return nullptr;
}

/// Where each person was at those times: x and y.
Json people_json(const World& world, const Json& times_s) {
  Json people = Json::array();
  for (const Person& person : world.people) {
    Json x = Json::array();
    Json y = Json::array();
    for (const Json& time_s : times_s) {
      const Vec3 foot_W = person.at(MissionTime{from_seconds(time_s.get<double>())}).foot_W;
      x.push_back(json_number(foot_W.x()));
      y.push_back(json_number(foot_W.y()));
    }
    people.push_back({{"x", std::move(x)}, {"y", std::move(y)}});
  }
  return people;
}

/// Heights at which the mission was flown, take-off and landing left out; those of its bounds where
/// the record has none.
HeightBand flown_heights(const MissionRecord& record) {
  const Aabb& bounds_W = record.world.bounds_W;
  std::optional<HeightBand> flown;
  for (const MemoryRecorder::Row& row : record.trace->rows()) {
    const Json height_m = row.channel == "state" ? value_of(row.fields, "z_m") : Json{};
    if (height_m.is_null() || !is_cruising(row.fields)) {
      continue;
    }
    const double z_m = height_m.get<double>();
    flown = flown ? HeightBand{std::min(flown->low_m, z_m), std::max(flown->high_m, z_m)}
                  : HeightBand{z_m, z_m};
  }
  return flown ? HeightBand{std::max(bounds_W.min.z(), flown->low_m - below_m),
                            std::min(bounds_W.max.z(), flown->high_m + above_m)}
               : HeightBand{bounds_W.min.z(), bounds_W.max.z()};
}

/// A figure that a mission judges itself by, as it stood at each time; null before there is one.
Json judged_json(const MemoryRecorder& trace,
                 std::string_view channel,
                 std::string_view field,
                 const Json& times_s) {
  Json values = Json::array();
  Json newest = nullptr;
  auto row = trace.rows().begin();
  for (const Json& time : times_s) {
    for (; row != trace.rows().end() && to_seconds(row->at) <= time.get<double>() + 1e-3; ++row) {
      newest = row->channel == channel ? value_of(row->fields, field) : newest;
    }
    values.push_back(newest);
  }
  return values;
}

Json series_json(const MemoryRecorder& trace) {
  std::vector<const MemoryRecorder::Row*> states;
  for (const MemoryRecorder::Row& row : trace.rows()) {
    if (row.channel == "state") {
      states.push_back(&row);
    }
  }
  Json json{{"t", Json::array()}};
  for (const Series& series : series_of_state) {
    json[series.name] = Json::array();
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i % rows_per_sample != 0 && i + 1 != states.size()) {  // The end is always there.
      continue;
    }
    json["t"].push_back(json_number(to_seconds(states[i]->at)));
    for (const Series& series : series_of_state) {
      json[series.name].push_back(value_of(states[i]->fields, series.field));
    }
  }
  json["coverage"] = judged_json(trace, "coverage", "coverage_percent", json["t"]);
  return json;
}

/// The numbers of each row of a channel, in the order of its fields, and then its time.
Json rows_json(const MemoryRecorder& trace, std::string_view channel) {
  Json rows = Json::array();
  for (const MemoryRecorder::Row& row : trace.rows()) {
    if (row.channel != channel) {
      continue;
    }
    Json numbers = Json::array();
    for (const Field& field : row.fields) {
      numbers.push_back(value_of(row.fields, field.name));
    }
    numbers.push_back(json_number(to_seconds(row.at)));
    rows.push_back(std::move(numbers));
  }
  return rows;
}

}  // namespace

RunPicture picture_of(const MissionRecord& record) {
  const Summary& summary = record.summary;
  const HeightBand flown = flown_heights(record);
  Json json{{"policy", summary.policy},
            {"seed", summary.seed},
            {"status", to_string(summary.status)},
            {"failure", to_string(summary.failure)},
            {"world", world_json(record.world, flown, record.has_goal)},
            {"series", series_json(*record.trace)}};
  if (!record.world.people.empty()) {
    json["people"] = people_json(record.world, json["series"]["t"]);
  }
  if (!record.map.empty()) {
    json["map"] = map_json(record.map, record.world.bounds_W, flown);
  }
  if (Json knobs = knobs_json(record); !knobs.empty()) {
    json["knobs"] = std::move(knobs);
  }
  if (Json steps = fallback_json(*record.trace); !steps.empty()) {
    json["fallback"] = std::move(steps);
  }
  // What a survey photographed: rectangles to be covered, and footprints of pictures; and whom a
  // search took for a person.
  for (const char* const channel : {"area", "footprint", "sighting"}) {
    if (Json rows = rows_json(*record.trace, channel); !rows.empty()) {
      json[channel] = std::move(rows);
    }
  }
  return {summary, json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace flyball
