// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/summary.h"

#include "flyball/records/text_table.h"

#include "records/json_counts.h"
#include "records/summary_reader.h"
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array statuses{MissionStatus::succeeded, MissionStatus::failed,
                              MissionStatus::interrupted};
constexpr std::array failures{MissionFailure::none,
                              MissionFailure::collision,
                              MissionFailure::battery_empty,
                              MissionFailure::no_plan,
                              MissionFailure::time_limit,
                              MissionFailure::target_lost,
                              MissionFailure::localization_lost,
                              MissionFailure::not_found,
                              MissionFailure::incomplete,
                              MissionFailure::false_alarm,
                              MissionFailure::misdelivered,
                              MissionFailure::autopilot};

/// Throws like the library's own getters when no value has this name.
template <class Value, std::size_t n>
Value named(const std::array<Value, n>& values, const std::string& name) {
  for (const Value value : values) {
    if (name == to_string(value)) {
      return value;
    }
  }
  throw std::out_of_range{"no status or failure is called \"" + name + "\""};
}

/// Null stands for a number that was not finite, of which nothing could be computed. Throws like
/// the library's own getters.
double number_in(const Json& json, const std::string& key) {
  const Json& value = json.at(key);
  if (!value.is_number()) {
    throw std::out_of_range{key + " = " + value.dump() + " is no number"};
  }
  return value.get<double>();
}

/// JSON has no infinity: a clearance without any obstacle, and nothing else, is written as null.
double clearance_in(const Json& json) {
  const char* const key = "min_clearance_m";
  return json.at(key).is_null() ? std::numeric_limits<double>::infinity() : number_in(json, key);
}

Json kernels_json(const Summary& summary) {
  Json kernels = Json::object();
  for (const auto& [name, kernel] : summary.kernels) {
    kernels[name] = {{"calls", kernel.calls},
                     {"mission_ms_mean", kernel.mission_ms_mean},
                     {"mission_ms_p95", kernel.mission_ms_p95},
                     {"host_ms_mean", kernel.host_ms_mean}};
  }
  return kernels;
}

void read_kernels(const Json& json, Summary& summary) {
  for (const auto& [name, kernel] : json.items()) {
    summary.kernels[name] = {count_in(kernel, "calls"), number_in(kernel, "mission_ms_mean"),
                             number_in(kernel, "mission_ms_p95"),
                             number_in(kernel, "host_ms_mean")};
  }
}

Json bounds_json(const Summary& summary) {
  Json levels = Json::array();
  for (const LevelBounds& level : summary.latency_bounds) {
    levels.push_back({{"resolution_m", level.resolution_m},
                      {"issued", level.issued},
                      {"late", level.late},
                      {"most_late", level.most_late ? Json(*level.most_late) : Json()}});
  }
  return levels;
}

void read_bounds(const Json& json, Summary& summary) {
  for (const Json& level : json) {
    const Json& most = level.at("most_late");
    summary.latency_bounds.push_back(
        {level.at("resolution_m").get<double>(), count_in(level, "issued"), count_in(level, "late"),
         most.is_null() ? std::nullopt : std::optional{most.get<double>()}});
  }
}

void read_head(const Json& json, Summary& summary) {
  summary.scenario = json.at("scenario").get<std::string>();
  summary.policy = json.at("policy").get<std::string>();
  summary.seed = count_in(json, "seed");
  summary.status = named(statuses, json.at("status").get<std::string>());
  summary.failure = named(failures, json.at("failure").get<std::string>());
  summary.host_s = number_in(json, "host_s");
  summary.real_time_factor = number_in(json, "real_time_factor");
  summary.trace_hash = json.at("trace_hash").get<std::string>();
  summary.numeric_fingerprint = json.at("numeric_fingerprint").get<std::string>();
  summary.version = json.at("version").get<std::string>();
}

void read_flight(const Json& json, Summary& summary) {
  summary.mission_time_s = number_in(json, "mission_time_s");
  summary.energy_rotor_j = number_in(json.at("energy_j"), "rotor");
  summary.energy_computer_j = number_in(json.at("energy_j"), "computer");
  summary.battery_start_percent = number_in(json, "battery_start_percent");
  summary.battery_end_percent = number_in(json, "battery_end_percent");
  summary.distance_m = number_in(json, "distance_m");
  summary.mean_speed_m_s = number_in(json, "mean_speed_m_s");
  summary.max_speed_m_s = number_in(json, "max_speed_m_s");
  summary.hover_time_s = number_in(json, "hover_time_s");
  summary.min_clearance_m = clearance_in(json);
}

void read_computing(const Json& json, Summary& summary) {
  summary.replans = count_in<int>(json, "replans");
  summary.deadline_misses = count_in(json, "deadline_misses");
  summary.decisions = count_in(json, "decisions");
  summary.knob_changes = count_in(json, "knob_changes");
  summary.policy_faults = count_in(json, "policy_faults");
  summary.policy_trouble = json.at("policy_trouble").get<std::string>();
  summary.latency_p50_s = number_in(json.at("latency_s"), "p50");
  summary.latency_p95_s = number_in(json.at("latency_s"), "p95");
  summary.latency_max_s = number_in(json.at("latency_s"), "max");
  summary.maps = count_in(json, "maps");
  summary.bound_overruns = count_in(json, "bound_overruns");
  summary.budget_use_p50 = number_in(json, "budget_use_p50");
  summary.decision_host_us_p50 = number_in(json.at("decision_host_us"), "p50");
  summary.decision_host_us_p99 = number_in(json.at("decision_host_us"), "p99");
  summary.throttle_events = count_in(json, "throttle_events");
  if (const Json& hottest = json.at("hottest_c"); !hottest.is_null()) {
    summary.hottest_c = hottest.get<double>();
  }
  read_bounds(json.at("latency_bounds"), summary);
  read_kernels(json.at("kernels"), summary);
  const Json& quality = json.at("quality");
  for (const auto& [name, value] : quality.items()) {
    summary.quality[name] = number_in(quality, name);
  }
}

}  // namespace

std::string clearance_text(const Summary& summary, const std::string& unit) {
  const double least_m = std::min(summary.min_clearance_m, farthest_clearance_m);
  return rounded(least_m, 2) + unit + (least_m < farthest_clearance_m ? "" : " or more");
}

std::string trouble_text(std::uint64_t faults, std::uint64_t decisions, const std::string& why) {
  return faults == 0 ? ""
                     : "was replaced by safe settings in " + std::to_string(faults) + " of " +
                           std::to_string(decisions) +
                           " decisions (after some faults in a row it is not asked again): " + why;
}

std::string to_json(const Summary& summary, int indent) {
  const Json json{
      {"scenario", summary.scenario},
      {"policy", summary.policy},
      {"seed", summary.seed},
      {"status", to_string(summary.status)},
      {"failure", to_string(summary.failure)},
      {"mission_time_s", summary.mission_time_s},
      {"energy_j",
       {{"rotor", summary.energy_rotor_j},
        {"computer", summary.energy_computer_j},
        {"total", summary.energy_total_j()}}},
      {"battery_start_percent", summary.battery_start_percent},
      {"battery_end_percent", summary.battery_end_percent},
      {"battery_used_percent", summary.battery_used_percent()},
      {"distance_m", summary.distance_m},
      {"mean_speed_m_s", summary.mean_speed_m_s},
      {"max_speed_m_s", summary.max_speed_m_s},
      {"hover_time_s", summary.hover_time_s},
      {"min_clearance_m", summary.min_clearance_m},
      {"replans", summary.replans},
      {"deadline_misses", summary.deadline_misses},
      {"decisions", summary.decisions},
      {"knob_changes", summary.knob_changes},
      {"policy_faults", summary.policy_faults},
      {"policy_trouble", summary.policy_trouble},
      {"latency_s",
       {{"p50", summary.latency_p50_s},
        {"p95", summary.latency_p95_s},
        {"max", summary.latency_max_s}}},
      {"maps", summary.maps},
      {"bound_overruns", summary.bound_overruns},
      {"budget_use_p50", summary.budget_use_p50},
      {"latency_bounds", bounds_json(summary)},
      {"decision_host_us",
       {{"p50", summary.decision_host_us_p50}, {"p99", summary.decision_host_us_p99}}},
      {"throttle_events", summary.throttle_events},
      {"hottest_c", summary.hottest_c ? Json(*summary.hottest_c) : Json()},
      {"kernels", kernels_json(summary)},
      {"quality", Json(summary.quality)},
      {"host_s", summary.host_s},
      {"real_time_factor", summary.real_time_factor},
      {"trace_hash", summary.trace_hash},
      {"numeric_fingerprint", summary.numeric_fingerprint},
      {"version", summary.version},
  };
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

bool from_json(const std::string& text, Summary& summary) {
  Result<Summary> read = read_summary(text);
  if (read) {
    summary = std::move(*read);
  }
  return read.ok();
}

Result<Summary> read_summary(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    Summary read;
    read_head(json, read);
    read_flight(json, read);
    read_computing(json, read);
    return read;
  } catch (const std::exception& error) {  // No JSON, a key is missing, a value of another kind.
    return Error{ErrorCode::invalid_input, std::string{"is no summary: "} + error.what()};
  }
}

}  // namespace flyball
