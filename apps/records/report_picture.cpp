// SPDX-License-Identifier: BSD-3-Clause
// tested-in: report

#include "flyball/records/report.h"

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

/// Square cells over the bounds, filled where a box is.
class Raster {
 public:
  explicit Raster(const Aabb& bounds_W)
      : bounds_W_{bounds_W}, extent_{bounds_W.max - bounds_W.min} {
    cell_m_ = std::max(0.05, std::max(extent_.x(), extent_.y()) / raster_columns);
    columns_ = static_cast<std::size_t>(std::ceil(extent_.x() / cell_m_)) + 1;
    rows_.assign(static_cast<std::size_t>(std::ceil(extent_.y() / cell_m_)) + 1,
                 std::vector<bool>(columns_));
  }

  void fill(const Aabb& box) {
    const Vec3 from = box.min - bounds_W_.min;
    const Vec3 to = box.max - bounds_W_.min;
    if (to.x() < 0.0 || to.y() < 0.0 || from.x() > extent_.x() || from.y() > extent_.y()) {
      return;
    }
    for (std::size_t y = index(from.y(), rows_.size()); y <= index(to.y(), rows_.size()); ++y) {
      const auto row = rows_[y].begin();
      std::fill(row + static_cast<std::ptrdiff_t>(index(from.x(), columns_)),
                row + static_cast<std::ptrdiff_t>(index(to.x(), columns_)) + 1, true);
    }
  }

  /// Each row lists start and length of its runs.
  [[nodiscard]] Json json() const {
    Json rows = Json::array();
    for (const std::vector<bool>& row : rows_) {
      rows.push_back(runs_of(row));
    }
    return {{"x_m", bounds_W_.min.x()},
            {"y_m", bounds_W_.min.y()},
            {"cell_m", cell_m_},
            {"rows", std::move(rows)}};
  }

 private:
  [[nodiscard]] std::size_t index(double at_m, std::size_t count) const {
    return static_cast<std::size_t>(
        std::clamp(at_m / cell_m_, 0.0, static_cast<double>(count - 1)));
  }
  static Json runs_of(const std::vector<bool>& row) {
    Json runs = Json::array();
    for (auto begin = std::find(row.begin(), row.end(), true); begin != row.end();) {
      const auto end = std::find(begin, row.end(), false);
      runs.push_back(begin - row.begin());
      runs.push_back(end - begin);
      begin = std::find(end, row.end(), true);
    }
    return runs;
  }

  Aabb bounds_W_;
  Vec3 extent_;
  double cell_m_{};
  std::size_t columns_{};
  std::vector<std::vector<bool>> rows_{};
};

Json raster(const World& world, const std::vector<Aabb>& boxes) {
  Raster cells{world.bounds_W};
  for (const Aabb& box : boxes) {
    cells.fill(box);
  }
  return cells.json();
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
    json["t"].push_back(rounded(to_seconds(states[i]->at)));
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
    numbers.push_back(rounded(to_seconds(row.at)));
    rows.push_back(std::move(numbers));
  }
  return rows;
}

}  // namespace

RunPicture picture_of(const MissionRecord& record) {
  const Summary& summary = record.summary;
  Json json{{"policy", summary.policy},
            {"seed", summary.seed},
            {"status", to_string(summary.status)},
            {"failure", to_string(summary.failure)},
            {"world", world_json(record.world)},
            {"series", series_json(*record.trace)}};
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
