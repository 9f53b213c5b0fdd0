// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tournament.h"

#include "flyball/records/text_table.h"

#include "studies/tournament_figures.h"
#include <algorithm>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

bool has_flown(const Comparison& comparison, const std::string& policy) {
  return std::any_of(comparison.rows.begin(), comparison.rows.end(),
                     [&](const ComparisonRow& row) { return row.policy == policy; });
}

WorldResult result_of(const std::vector<Summary>& flights,
                      const KnownBounds& bounds,
                      const std::vector<PolicyPair>& pairs) {
  WorldResult world;
  world.comparison = compare_flights(flights);
  const std::string& first = world.comparison.rows.front().policy;
  for (const ComparisonRow& row : world.comparison.rows) {
    world.decisions.push_back(decisions_of(flights, row.policy, bounds));
    for (BoundFigures& level : bound_figures(flights, row.policy)) {
      world.latency_bounds.push_back(std::move(level));
    }
    if (row.policy != first) {
      world.differences.push_back(difference_of(flights, {row.policy, first}));
    }
  }
  for (const PolicyPair& pair : pairs) {
    if (has_flown(world.comparison, pair.policy) && has_flown(world.comparison, pair.to)) {
      world.pairs.push_back(difference_of(flights, pair));
    }
  }
  return world;
}

Json json_of(const std::optional<MedianInterval>& interval) {
  return interval ? Json{{"median", interval->median}, {"lo", interval->lo}, {"hi", interval->hi}}
                  : Json{{"median", nullptr}, {"lo", nullptr}, {"hi", nullptr}};
}

Json json_of(const PairedDifference& difference) {
  return {{"policy", difference.policy},
          {"to", difference.to},
          {"pairs", difference.pairs},
          {"wins", difference.wins},
          {"mission_time_s", json_of(difference.time_s)},
          {"energy_total_j", json_of(difference.energy_j)},
          {"energy_percent", json_of(difference.energy_percent)},
          {"computer_percent", json_of(difference.computer_percent)},
          {"battery_used_percent", json_of(difference.battery_percent)}};
}

Json json_of(const WorldResult& world) {
  Json json = Json::parse(to_json(world.comparison));
  for (std::size_t i = 0; i < world.decisions.size(); ++i) {
    Json& row = json["rows"][i];
    row["overrun_percent"] = json_of(world.decisions[i].overrun_percent);
    row["budget_use"] = json_of(world.decisions[i].budget_use);
    if (world.decisions[i].over_bound) {
      row["energy_over_bound"] = json_of(world.decisions[i].over_bound);
    }
    if (world.decisions[i].throttle_events) {
      row["throttle_events"] = *world.decisions[i].throttle_events;
    }
  }
  if (world.hindsight) {
    json["fixed_best"] = {{"setting", world.hindsight->setting},
                          {"preset", world.hindsight->preset},
                          {"tried", world.hindsight->tried},
                          {"on_grid", world.hindsight->on_grid},
                          {"borders", world.hindsight->borders}};
  }
  json["differences"] = Json::array();
  for (const auto* differences : {&world.differences, &world.pairs}) {
    for (const PairedDifference& difference : *differences) {
      json["differences"].push_back(json_of(difference));
    }
  }
  json["latency_bounds"] = Json::array();
  for (const BoundFigures& level : world.latency_bounds) {
    json["latency_bounds"].push_back(
        {{"policy", level.policy},
         {"resolution_m", level.resolution_m},
         {"issued", level.issued},
         {"late", level.late},
         {"most_late", level.most_late ? Json(*level.most_late) : Json()}});
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

std::string differences_text(const std::string& head,
                             const std::vector<PairedDifference>& differences,
                             bool names_both) {
  if (differences.empty()) {
    return {};
  }
  std::vector<std::vector<std::string>> lines{
      {head, "pairs", "wins", "time s", "energy kJ", "energy %", "computer %", "battery %"}};
  for (const PairedDifference& d : differences) {
    lines.push_back({names_both ? d.name() : d.policy, std::to_string(d.pairs),
                     std::to_string(d.wins), figure(d.time_s, 1.0, 1), figure(d.energy_j, 1e-3, 1),
                     figure(d.energy_percent, 1.0, 1), figure(d.computer_percent, 1.0, 1),
                     figure(d.battery_percent, 1.0, 1)});
  }
  return aligned(lines);
}

std::string hindsight_text(const WorldResult& world) {
  return world.hindsight ? "fixed_best: " + world.hindsight->text() + "\n" : std::string{};
}

std::string decisions_text(const WorldResult& world) {
  const bool has_bound = world.has_bound();
  const bool has_heat = world.has_heat();
  std::vector<std::vector<std::string>> lines{{"decisions", "late maps %", "budget use"}};
  if (has_bound) {
    lines.front().emplace_back("energy / bound");
  }
  if (has_heat) {
    lines.front().emplace_back("throttled");
  }
  for (const DecisionFigures& d : world.decisions) {
    lines.push_back({d.policy, figure(d.overrun_percent, 1.0, 2), figure(d.budget_use, 1.0, 2)});
    if (has_bound) {
      lines.back().push_back(figure(d.over_bound, 1.0, 2));
    }
    if (has_heat) {
      lines.back().push_back(d.throttle_events ? std::to_string(*d.throttle_events) : "-");
    }
  }
  return aligned(lines);
}

std::string bounds_text(const WorldResult& world) {
  if (world.latency_bounds.empty()) {
    return {};
  }
  std::vector<std::vector<std::string>> lines{
      {"latency bounds", "cells m", "issued", "late", "late %", "at most %"}};
  for (const BoundFigures& level : world.latency_bounds) {
    const auto most = level.most_percent();
    lines.push_back({level.policy, rounded(level.resolution_m, 2), std::to_string(level.issued),
                     std::to_string(level.late), rounded(level.late_percent(), 1),
                     most ? rounded(*most, 1) : "-"});
  }
  return aligned(lines);
}

}  // namespace

bool WorldResult::has_bound() const {
  return std::any_of(decisions.begin(), decisions.end(),
                     [](const DecisionFigures& d) { return d.over_bound.has_value(); });
}

bool WorldResult::has_heat() const {
  return std::any_of(decisions.begin(), decisions.end(),
                     [](const DecisionFigures& d) { return d.throttle_events.has_value(); });
}

std::vector<WorldResult> tournament_of(const std::vector<Summary>& flights,
                                       const KnownBounds& bounds,
                                       const std::vector<PolicyPair>& pairs) {
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
    worlds.push_back(result_of(world, bounds, pairs));
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
    text +=
        (text.empty() ? "" : "\n") + to_text(world.comparison) + hindsight_text(world) +
        differences_text("less " + world.comparison.rows.front().policy, world.differences, false) +
        differences_text("pairs", world.pairs, true) + decisions_text(world) + bounds_text(world);
  }
  return text;
}

}  // namespace flyball
