// SPDX-License-Identifier: BSD-3-Clause
// tested-in: replay

#include "flyball/records/summary.h"
#include "flyball/runtime/observation_fields.h"
#include "flyball/studies/replay.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

MissionTime time_of(const Json& row) {
  return MissionTime{nearest_duration(row.at("t_s").get<double>())};
}

/// A number that was not finite stands as null.
double number_of(const Json& value) {
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

void take_observation(const Json& row, RecordedFlight& flight) {
  auto& changes = flight.changes[time_of(row)];
  for (const auto& [name, value] : row.items()) {
    if (const auto field = index_of(name)) {
      changes.emplace_back(*field, number_of(value));
    }
  }
}

/// @return  Whether the row is about decisions.
void take_row(const Json& row, RecordedFlight& flight) {
  const auto& channel = row.at("channel").get_ref<const std::string&>();
  if (channel == "observation" || channel == "computer") {
    take_observation(row, flight);
  } else if (channel == "choice") {
    flight.choices[time_of(row)] = row.at("what").get<std::string>();
  } else if (channel == "governor") {
    flight.period = nearest_duration(row.at("period_s").get<double>());
  } else if (channel == "mission") {
    flight.version = row.at("version").get<std::string>();
  }
}

Status read_trace(const std::string& path, RecordedFlight& flight) {
  std::ifstream file{path};
  if (!file) {
    return Error{ErrorCode::not_found,
                 "no file " + path + "; give the folder of a run, as `flyball run` writes it"};
  }
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    try {
      take_row(Json::parse(line), flight);
    } catch (const Json::exception&) {
      return Error{ErrorCode::invalid_input, path + ":" + std::to_string(number) +
                                                 ": is no row of a trace; fly the mission again"};
    }
  }
  if (flight.period <= Duration::zero() || flight.choices.empty()) {
    return Error{ErrorCode::invalid_input,
                 path + ": holds no decisions; it is older than this program, fly it again"};
  }
  return Done{};
}

Status read_scenario(const std::string& path, RecordedFlight& flight) {
  auto loaded = load_scenario(path, {});
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

}  // namespace

Result<RecordedFlight> read_flight(const std::string& folder) {
  const fs::path in{folder};
  RecordedFlight flight;
  if (const Status read = read_trace((in / "trace.jsonl").string(), flight); !read) {
    return read.error();
  }
  if (const Status read = read_scenario((in / "mission.toml").string(), flight); !read) {
    return read.error();
  }
  std::ifstream file{in / "summary.json"};
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  Summary summary;
  if (!from_json(text, summary)) {
    return Error{ErrorCode::invalid_input,
                 (in / "summary.json").string() + ": is no summary; fly the mission again"};
  }
  flight.decisions = summary.decisions;
  return flight;
}

}  // namespace flyball
