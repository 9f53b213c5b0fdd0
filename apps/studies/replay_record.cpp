// SPDX-License-Identifier: BSD-3-Clause
// tested-in: replay

#include "flyball/flight/governing/choice_text.h"
#include "flyball/governors/policy_period.h"
#include "flyball/runtime/observation_fields.h"
#include "flyball/scenario/files.h"
#include "flyball/studies/replay.h"

#include "records/json_counts.h"
#include "records/summary_reader.h"
#include "scenario/scenario_reader.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

namespace fs = std::filesystem;
using JsonRow = nlohmann::json;

MissionTime time_of(const JsonRow& row) {
  return MissionTime{seconds_in(row, "t_s")};
}

/// A number that was not finite stands as null.
double number_of(const JsonRow& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

std::optional<std::size_t> index_of(const std::string& name) {
  const auto& fields = observation_fields();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].name == name) {
      return i;
    }
  }
  return std::nullopt;
}

void take_observation(const JsonRow& row, RecordedFlight& flight) {
  auto& changes = flight.changes[time_of(row)];
  for (const auto& [name, value] : row.items()) {
    if (const auto field = index_of(name)) {
      changes.emplace_back(*field, number_of(value));
    }
  }
}

/// @throw As the library's getters, or in words, when the row is damaged.
void take_row(const JsonRow& row, RecordedFlight& flight) {
  const auto& channel = row.at("channel").get_ref<const std::string&>();
  if (channel == "observation" || channel == "computer") {
    take_observation(row, flight);
  } else if (channel == "choice") {
    const auto& what = row.at("what").get_ref<const std::string&>();
    if (!settings_of(what)) {
      throw std::out_of_range{"what = \"" + what + "\" is no choice"};
    }
    flight.choices[time_of(row)] = what;
  } else if (channel == "governor") {
    flight.period = seconds_in(row, "period_s");
    if (const auto fault = fault_of_period(to_seconds(flight.period)); fault[0] != '\0') {
      throw std::out_of_range{fault.data()};
    }
    if (row.contains("decision")) {
      flight.after_drops[row.at("decision").get<std::uint64_t>()] = time_of(row);
    }
  } else if (channel == "mission") {
    flight.version = row.at("version").get<std::string>();
  }
  flight.end = std::max(flight.end, time_of(row));
}

Status read_trace(const std::string& path, RecordedFlight& flight) {
  std::error_code failed;
  std::ifstream file{path};
  if (!file || !fs::is_regular_file(path, failed)) {
    return Error{ErrorCode::not_found,
                 "no file " + path + "; give the folder of a run, as `flyball run` writes it"};
  }
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    try {
      take_row(JsonRow::parse(line), flight);
    } catch (const std::exception& error) {
      return Error{ErrorCode::invalid_input, path + ":" + std::to_string(number) +
                                                 ": is no row of a trace (" + error.what() +
                                                 "); fly the mission again"};
    }
  }
  // Rows come at 10 Hz at least. A time that was damaged would make a flight of days, each of whose
  // decisions is made again.
  constexpr Duration widest_gap = std::chrono::seconds{1};
  if (flight.end.time_since_epoch() / widest_gap > static_cast<Duration::rep>(number)) {
    return Error{ErrorCode::invalid_input,
                 path + ": " + std::to_string(number) + " rows cannot be a flight of " +
                     std::to_string(to_seconds(flight.end)) + " s; fly the mission again"};
  }
  if (flight.period <= Duration::zero() || flight.choices.empty()) {
    return Error{ErrorCode::invalid_input,
                 path + ": holds no decisions; it is older than this program, fly it again"};
  }
  return Done{};
}

/// A record names files as its command did: it holds no folders of the computer that flew it, and
/// can be moved together with them. One that is not there was named from another folder.
std::optional<Error> file_out_of_sight(const std::string& path) {
  const ScenarioText text = read_scenario_file(path);
  for (const auto& [key, kind] :
       {std::pair{"governor.policy", "presets"}, std::pair{"platform.name", "platforms"},
        std::pair{"edge.platform", "platforms"}, std::pair{"vehicle.airframe", "airframes"}}) {
    const auto given = text.values.find(key);
    const std::string name =
        given == text.values.end() ? std::string{} : as_text(given->second).value_or("");
    std::error_code failed;
    if (looks_like_path(kind, name) && fs::path{name}.is_relative() && !fs::exists(name, failed)) {
      return Error{ErrorCode::not_found,
                   path + ": " + key + " = \"" + name +
                       "\", and there is no such file from here; go to the folder from which the "
                       "mission was flown"};
    }
  }
  return std::nullopt;
}

Status read_scenario(const std::string& path, const Plugins& plugins, RecordedFlight& flight) {
  if (const auto hidden = file_out_of_sight(path)) {
    return *hidden;
  }
  auto loaded = load_scenario(path, {}, plugins);
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    Error all{errors->front().code, ""};
    for (const Error& error : *errors) {
      all.message += (all.message.empty() ? "" : "\n") + error.message;
    }
    return all;
  }
  flight.scenario = std::move(std::get<LoadedScenario>(loaded).scenario);
  return Done{};
}

/// The number of decisions, which must be no more than the flight had time for.
Status read_decisions(const std::string& path, RecordedFlight& flight) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) {
    return Error{ErrorCode::not_found,
                 "no file " + path + "; give the folder of a run, as `flyball run` writes it"};
  }
  std::ifstream file{path};
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  const Result<Summary> summary = read_summary(text);
  if (!summary) {
    return Error{ErrorCode::invalid_input,
                 path + ": " + summary.error().message + "; fly the mission again"};
  }
  // One is at 0, and some may come after the last row: rows come at 10 Hz at least.
  constexpr Duration after_last = std::chrono::seconds{1};
  const auto most =
      static_cast<std::uint64_t>((flight.end.time_since_epoch() + after_last) / flight.period + 1);
  if (summary->decisions > most) {
    return Error{ErrorCode::invalid_input,
                 path + ": decisions = " + std::to_string(summary->decisions) +
                     ", but a trace of " + std::to_string(to_seconds(flight.end)) +
                     " s has time for " + std::to_string(most) + "; fly the mission again"};
  }
  flight.decisions = summary->decisions;
  return Done{};
}

}  // namespace

Result<RecordedFlight> read_flight(const std::string& folder, const Plugins& plugins) {
  const fs::path in{folder};
  RecordedFlight flight;
  if (const Status read = read_trace((in / "trace.jsonl").string(), flight); !read) {
    return read.error();
  }
  if (const Status read = read_scenario((in / "mission.toml").string(), plugins, flight); !read) {
    return read.error();
  }
  if (const Status read = read_decisions((in / "summary.json").string(), flight); !read) {
    return read.error();
  }
  return flight;
}

}  // namespace flyball
