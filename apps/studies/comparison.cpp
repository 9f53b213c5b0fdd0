// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/comparison.h"

#include "flyball/runtime/text/listed.h"

#include <algorithm>
#include <iterator>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;
using Flights = std::vector<const Summary*>;

template <class Quantity>
std::optional<MedianInterval> median_over(const Flights& flights, Quantity quantity) {
  std::vector<double> values;
  for (const Summary* flight : flights) {
    if (has_succeeded(*flight)) {
      values.push_back(quantity(*flight));
    }
  }
  return bootstrap_median(values);
}

/// Counts of the flights by how they ended.
ComparisonRow counted(const Flights& flights) {
  ComparisonRow row;
  row.policy = flights.front()->policy;
  row.n = static_cast<int>(flights.size());
  for (const Summary* flight : flights) {
    row.trouble.add(*flight);
    if (has_succeeded(*flight)) {
      ++row.succeeded;
      continue;
    }
    row.collisions += flight->failure == MissionFailure::collision ? 1 : 0;
    ++row.failures[flight->status == MissionStatus::interrupted ? to_string(flight->status)
                                                                : to_string(flight->failure)];
  }
  return row;
}

void add_ratios(ComparisonRow& row, const Flights& flights, const Flights& first) {
  std::vector<double> battery;
  std::vector<double> time;
  for (const Summary* flight : flights) {
    const auto same_seed = [flight](const Summary* other) { return other->seed == flight->seed; };
    const auto other = std::find_if(first.begin(), first.end(), same_seed);
    if (other == first.end() || !has_succeeded(*flight) || !has_succeeded(**other)) {
      continue;
    }
    if ((*other)->battery_used_percent() > 0.0 && (*other)->mission_time_s > 0.0) {
      battery.push_back(flight->battery_used_percent() / (*other)->battery_used_percent());
      time.push_back(flight->mission_time_s / (*other)->mission_time_s);
    }
  }
  row.pairs = static_cast<int>(time.size());
  row.battery_ratio = bootstrap_median(battery);
  row.time_ratio = bootstrap_median(time);
}

ComparisonRow row_of(const Flights& flights, const Flights& first) {
  ComparisonRow row = counted(flights);
  row.mission_time_s = median_over(flights, [](const Summary& s) { return s.mission_time_s; });
  row.energy_total_j = median_over(flights, [](const Summary& s) { return s.energy_total_j(); });
  row.battery_used_percent =
      median_over(flights, [](const Summary& s) { return s.battery_used_percent(); });
  row.mean_speed_m_s = median_over(flights, [](const Summary& s) { return s.mean_speed_m_s; });
  Flights mapping;  // The others have no latency from sensor to command.
  std::copy_if(flights.begin(), flights.end(), std::back_inserter(mapping),
               [](const Summary* flight) { return flight->maps > 0; });
  row.latency_p50_s = median_over(mapping, [](const Summary& s) { return s.latency_p50_s; });
  add_ratios(row, flights, first);
  return row;
}

Json to_json(const std::optional<MedianInterval>& interval) {
  return interval ? Json{{"median", interval->median}, {"lo", interval->lo}, {"hi", interval->hi}}
                  : Json{{"median", nullptr}, {"lo", nullptr}, {"hi", nullptr}};
}

Json to_json(const ComparisonRow& row) {
  return {{"policy", row.policy},
          {"n", row.n},
          {"succeeded", row.succeeded},
          {"collisions", row.collisions},
          {"failures", Json(row.failures)},
          {"policy_faults", row.trouble.faults},
          {"policy_trouble", row.trouble.why},
          {"mission_time_s", to_json(row.mission_time_s)},
          {"energy_total_j", to_json(row.energy_total_j)},
          {"battery_used_percent", to_json(row.battery_used_percent)},
          {"mean_speed_m_s", to_json(row.mean_speed_m_s)},
          {"latency_p50_s", to_json(row.latency_p50_s)},
          {"pairs", row.pairs},
          {"battery_ratio", to_json(row.battery_ratio)},
          {"time_ratio", to_json(row.time_ratio)}};
}

}  // namespace

Comparison compare_flights(const std::vector<Summary>& flights) {
  Comparison comparison;
  std::vector<Flights> by_policy;
  for (const Summary& flight : flights) {
    comparison.scenario = flight.scenario;
    const auto same_policy = [&](const Flights& group) {
      return group.front()->policy == flight.policy;
    };
    auto group = std::find_if(by_policy.begin(), by_policy.end(), same_policy);
    if (group == by_policy.end()) {
      group = by_policy.insert(by_policy.end(), Flights{});
    }
    group->push_back(&flight);
    comparison.seeds.push_back(flight.seed);
  }
  std::sort(comparison.seeds.begin(), comparison.seeds.end());
  comparison.seeds.erase(std::unique(comparison.seeds.begin(), comparison.seeds.end()),
                         comparison.seeds.end());
  for (const Flights& group : by_policy) {
    comparison.rows.push_back(row_of(group, by_policy.front()));
  }
  return comparison;
}

std::string to_json(const Comparison& comparison) {
  Json rows = Json::array();
  for (const ComparisonRow& row : comparison.rows) {
    rows.push_back(to_json(row));
  }
  return Json{{"scenario", comparison.scenario}, {"seeds", comparison.seeds}, {"rows", rows}}.dump(
      2, ' ', false, Json::error_handler_t::replace);
}

std::string seeds_text(const std::vector<std::uint64_t>& seeds) {
  const bool is_range = seeds.size() > 2 && seeds.back() - seeds.front() + 1 == seeds.size();
  if (is_range) {
    return std::to_string(seeds.front()) + ".." + std::to_string(seeds.back());
  }
  return listed(seeds);
}

}  // namespace flyball
