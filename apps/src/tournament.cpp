// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/apps/tournament.h"

#include "flyball/apps/text_table.h"

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;
using Flights = std::vector<const Summary*>;

bool has_succeeded(const Summary& flight) {
  return flight.status == MissionStatus::succeeded;
}

/// The succeeded flights of a policy, in the order of their seeds.
Flights flights_of(const std::vector<Summary>& all, const std::string& policy) {
  Flights found;
  for (const Summary& flight : all) {
    if (flight.policy == policy && has_succeeded(flight)) {
      found.push_back(&flight);
    }
  }
  return found;
}

template <class Quantity>
std::optional<MedianInterval> median_over(const Flights& flights, Quantity quantity) {
  std::vector<double> values;
  values.reserve(flights.size());
  for (const Summary* flight : flights) {
    values.push_back(quantity(*flight));
  }
  return bootstrap_median(values);
}

std::optional<MedianInterval> over_bound(const Flights& flights, const KnownBounds& bounds) {
  std::vector<double> ratios;
  for (const Summary* flight : flights) {
    const auto least_j = bounds.find({flight->scenario, flight->seed});
    if (least_j != bounds.end() && least_j->second > 0.0) {
      ratios.push_back(flight->energy_total_j() / least_j->second);
    }
  }
  return bootstrap_median(ratios);
}

DecisionFigures decisions_of(const std::vector<Summary>& all,
                             const std::string& policy,
                             const KnownBounds& bounds) {
  const Flights flights = flights_of(all, policy);
  DecisionFigures figures;
  figures.policy = policy;
  figures.overrun_percent = median_over(flights, [](const Summary& s) {
    return s.maps == 0
               ? 0.0
               : 100.0 * static_cast<double>(s.bound_overruns) / static_cast<double>(s.maps);
  });
  figures.budget_use = median_over(flights, [](const Summary& s) { return s.budget_use_p50; });
  figures.decision_us =
      median_over(flights, [](const Summary& s) { return s.decision_host_us_p99; });
  figures.over_bound = over_bound(flights, bounds);
  return figures;
}

PairedDifference difference_of(const std::vector<Summary>& all,
                               const std::string& policy,
                               const std::string& first) {
  std::map<std::uint64_t, const Summary*> others;
  for (const Summary* flight : flights_of(all, first)) {
    others[flight->seed] = flight;
  }
  PairedDifference difference;
  difference.policy = policy;
  std::vector<double> time_s;
  std::vector<double> energy_j;
  std::vector<double> battery;
  std::vector<double> percent;
  std::vector<double> computer;
  for (const Summary* flight : flights_of(all, policy)) {
    const auto found = others.find(flight->seed);
    if (found == others.end()) {
      continue;
    }
    const Summary& other = *found->second;
    time_s.push_back(flight->mission_time_s - other.mission_time_s);
    energy_j.push_back(flight->energy_total_j() - other.energy_total_j());
    battery.push_back(flight->battery_used_percent() - other.battery_used_percent());
    percent.push_back(100.0 * energy_j.back() / other.energy_total_j());
    if (other.energy_computer_j > 0.0) {
      computer.push_back(100.0 * (flight->energy_computer_j / other.energy_computer_j - 1.0));
    }
    difference.wins += energy_j.back() < 0.0 ? 1 : 0;
  }
  difference.pairs = static_cast<int>(energy_j.size());
  difference.time_s = bootstrap_median(time_s);
  difference.energy_j = bootstrap_median(energy_j);
  difference.battery_percent = bootstrap_median(battery);
  difference.energy_percent = bootstrap_median(percent);
  difference.computer_percent = bootstrap_median(computer);
  return difference;
}

WorldResult result_of(const std::vector<Summary>& flights, const KnownBounds& bounds) {
  WorldResult world;
  world.comparison = compare_flights(flights);
  for (const ComparisonRow& row : world.comparison.rows) {
    world.decisions.push_back(decisions_of(flights, row.policy, bounds));
    if (row.policy != world.comparison.rows.front().policy) {
      world.differences.push_back(
          difference_of(flights, row.policy, world.comparison.rows.front().policy));
    }
  }
  return world;
}

Json json_of(const std::optional<MedianInterval>& interval) {
  return interval ? Json{{"median", interval->median}, {"lo", interval->lo}, {"hi", interval->hi}}
                  : Json{{"median", nullptr}, {"lo", nullptr}, {"hi", nullptr}};
}

Json json_of(const WorldResult& world) {
  Json json = Json::parse(to_json(world.comparison));
  for (std::size_t i = 0; i < world.decisions.size(); ++i) {
    Json& row = json["rows"][i];
    row["overrun_percent"] = json_of(world.decisions[i].overrun_percent);
    row["budget_use"] = json_of(world.decisions[i].budget_use);
    row["decision_us"] = json_of(world.decisions[i].decision_us);
    if (world.decisions[i].over_bound) {
      row["energy_over_bound"] = json_of(world.decisions[i].over_bound);
    }
  }
  json["differences"] = Json::array();
  for (const PairedDifference& difference : world.differences) {
    json["differences"].push_back({{"policy", difference.policy},
                                   {"to", world.comparison.rows.front().policy},
                                   {"pairs", difference.pairs},
                                   {"wins", difference.wins},
                                   {"mission_time_s", json_of(difference.time_s)},
                                   {"energy_total_j", json_of(difference.energy_j)},
                                   {"energy_percent", json_of(difference.energy_percent)},
                                   {"computer_percent", json_of(difference.computer_percent)},
                                   {"battery_used_percent", json_of(difference.battery_percent)}});
  }
  return json;
}

std::string figure(const std::optional<MedianInterval>& value, double scale, int digits) {
  if (!value) {
    return "-";
  }
  const auto show = [&](double x) { return rounded(x * scale, digits); };
  return show(value->median) + " [" + show(value->lo) + ", " + show(value->hi) + "]";
}

std::string differences_text(const WorldResult& world) {
  if (world.differences.empty()) {
    return {};
  }
  std::vector<std::vector<std::string>> lines{{"less " + world.comparison.rows.front().policy,
                                               "pairs", "wins", "time s", "energy kJ", "energy %",
                                               "computer %", "battery %"}};
  for (const PairedDifference& d : world.differences) {
    lines.push_back({d.policy, std::to_string(d.pairs), std::to_string(d.wins),
                     figure(d.time_s, 1.0, 1), figure(d.energy_j, 1e-3, 1),
                     figure(d.energy_percent, 1.0, 1), figure(d.computer_percent, 1.0, 1),
                     figure(d.battery_percent, 1.0, 1)});
  }
  return aligned(lines);
}

std::string decisions_text(const WorldResult& world) {
  const bool has_bound = world.has_bound();
  std::vector<std::vector<std::string>> lines{
      {"decisions", "late maps %", "budget use", "99 % within us"}};
  if (has_bound) {
    lines.front().emplace_back("energy / bound");
  }
  for (const DecisionFigures& d : world.decisions) {
    lines.push_back({d.policy, figure(d.overrun_percent, 1.0, 2), figure(d.budget_use, 1.0, 2),
                     figure(d.decision_us, 1.0, 1)});
    if (has_bound) {
      lines.back().push_back(figure(d.over_bound, 1.0, 2));
    }
  }
  return aligned(lines);
}

}  // namespace

bool WorldResult::has_bound() const {
  return std::any_of(decisions.begin(), decisions.end(),
                     [](const DecisionFigures& d) { return d.over_bound.has_value(); });
}

std::vector<WorldResult> tournament_of(const std::vector<Summary>& flights,
                                       const KnownBounds& bounds) {
  std::vector<std::vector<Summary>> by_world;
  for (const Summary& flight : flights) {
    const auto same = [&](const std::vector<Summary>& world) {
      return world.front().scenario == flight.scenario;
    };
    auto world = std::find_if(by_world.begin(), by_world.end(), same);
    if (world == by_world.end()) {
      world = by_world.insert(by_world.end(), std::vector<Summary>{});
    }
    world->push_back(flight);
  }
  std::vector<WorldResult> worlds;
  worlds.reserve(by_world.size());
  for (const std::vector<Summary>& world : by_world) {
    worlds.push_back(result_of(world, bounds));
  }
  return worlds;
}

std::string to_json(const std::vector<WorldResult>& worlds) {
  Json json = Json::array();
  for (const WorldResult& world : worlds) {
    json.push_back(json_of(world));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string to_text(const std::vector<WorldResult>& worlds) {
  std::string text;
  for (const WorldResult& world : worlds) {
    text += (text.empty() ? "" : "\n") + to_text(world.comparison) + differences_text(world) +
            decisions_text(world);
  }
  return text;
}

}  // namespace flyball
