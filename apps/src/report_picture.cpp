// SPDX-License-Identifier: BSD-3-Clause
// tested-in: report

#include "flyball/apps/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t rows_per_sample = 5;  // `state` has 10 rows a second; the page needs 2.
constexpr std::size_t most_boxes = 5000;    // More are drawn as a raster.
constexpr double raster_columns = 800.0;    // About the pixels that the page has for it.

/// Rounded to a thousandth: the page's size is mostly digits. Null when not finite.
Json rounded(double value) {
  return std::isfinite(value) ? Json(std::round(value * 1e3) / 1e3) : Json(nullptr);
}

Json corner(const Vec3& p_W) {
  return {rounded(p_W.x()), rounded(p_W.y())};
}

/// Only what stands at flight height is in the way: a ceiling would hide the rooms below it.
bool is_at_flight_height(const World& world, double low_m, double high_m) {
  return high_m > world.bounds_W.min.z() && low_m < world.bounds_W.max.z();
}

std::vector<Aabb> boxes_in_the_way(const World& world) {
  std::vector<Aabb> boxes;
  for (const Aabb& box : world.boxes) {
    if (is_at_flight_height(world, box.min.z(), box.max.z())) {
      boxes.push_back(box);
    }
  }
  return boxes;
}

/// Top view as filled cells; each row lists start and length of its runs.
Json raster(const World& world, const std::vector<Aabb>& boxes) {
  const Vec3 extent = world.bounds_W.max - world.bounds_W.min;
  const double cell_m = std::max(0.05, std::max(extent.x(), extent.y()) / raster_columns);
  const auto columns = static_cast<std::size_t>(std::ceil(extent.x() / cell_m)) + 1;
  const auto rows = static_cast<std::size_t>(std::ceil(extent.y() / cell_m)) + 1;
  std::vector<std::vector<bool>> filled(rows, std::vector<bool>(columns));
  const auto index = [cell_m](double at_m, double origin_m, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp((at_m - origin_m) / cell_m, 0.0, static_cast<double>(count - 1)));
  };
  for (const Aabb& box : boxes) {
    const std::size_t last_row = index(box.max.y(), world.bounds_W.min.y(), rows);
    const std::size_t last_column = index(box.max.x(), world.bounds_W.min.x(), columns);
    for (std::size_t y = index(box.min.y(), world.bounds_W.min.y(), rows); y <= last_row; ++y) {
      for (std::size_t x = index(box.min.x(), world.bounds_W.min.x(), columns); x <= last_column;
           ++x) {
        filled[y][x] = true;
      }
    }
  }
  Json runs = Json::array();
  for (const std::vector<bool>& row : filled) {
    Json line = Json::array();
    for (std::size_t x = 0; x < columns; ++x) {
      std::size_t end = x;
      while (end < columns && row[end]) {
        ++end;
      }
      if (end > x) {
        line.push_back(x);
        line.push_back(end - x);
        x = end;
      }
    }
    runs.push_back(std::move(line));
  }
  return {{"x_m", world.bounds_W.min.x()},
          {"y_m", world.bounds_W.min.y()},
          {"cell_m", cell_m},
          {"rows", runs}};
}

Json world_json(const World& world) {
  Json json{{"min", corner(world.bounds_W.min)},
            {"max", corner(world.bounds_W.max)},
            {"start", corner(world.start_W)},
            {"goal", corner(world.goal_W)}};
  const std::vector<Aabb> boxes = boxes_in_the_way(world);
  if (boxes.size() > most_boxes) {
    json["raster"] = raster(world, boxes);
  } else {
    json["boxes"] = Json::array();
    for (const Aabb& box : boxes) {
      json["boxes"].push_back(
          {rounded(box.min.x()), rounded(box.min.y()), rounded(box.max.x()), rounded(box.max.y())});
    }
  }
  json["pillars"] = Json::array();
  for (const Pillar& pillar : world.pillars) {
    if (is_at_flight_height(world, pillar.foot_W.z(), pillar.foot_W.z() + pillar.height_m)) {
      json["pillars"].push_back(
          {rounded(pillar.foot_W.x()), rounded(pillar.foot_W.y()), rounded(pillar.radius_m)});
    }
  }
  return json;
}

/// The page's name of a series and the trace's name of its field.
struct Series {
  const char* name;
  std::string_view field;
};

constexpr std::array<Series, 9> series_of_state{{
    {"x", "x_m"},
    {"y", "y_m"},
    {"speed", "speed_m_s"},
    {"limit", "set_speed_m_s"},
    {"resolution", "resolution_m"},
    {"latency", "latency_bound_s"},
    {"rotor", "rotor_w"},
    {"computer", "computer_w"},
    {"battery", "battery_percent"},
}};

Json value_of(const std::vector<Field>& fields, std::string_view name) {
  for (const Field& field : fields) {
    if (field.name != name) {
      continue;
    }
    if (const double* number = std::get_if<double>(&field.value)) {
      return rounded(*number);
    }
  }
  return nullptr;
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
    json["t"].push_back(rounded(to_seconds(states[i]->at)));
    for (const Series& series : series_of_state) {
      json[series.name].push_back(value_of(states[i]->fields, series.field));
    }
  }
  return json;
}

}  // namespace

RunPicture picture_of(const MissionRecord& record) {
  const Summary& summary = record.summary;
  const Json json{{"policy", summary.policy},
                  {"seed", summary.seed},
                  {"status", to_string(summary.status)},
                  {"failure", to_string(summary.failure)},
                  {"world", world_json(record.world)},
                  {"series", series_json(*record.trace)}};
  return {summary, json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace flyball
