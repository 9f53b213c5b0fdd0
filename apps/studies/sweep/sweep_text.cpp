// SPDX-License-Identifier: BSD-3-Clause
// tested-in: sweep

#include "flyball/records/text_table.h"
#include "flyball/studies/comparison.h"
#include "flyball/studies/sweep.h"

#include "studies/plots/csv.h"
#include "studies/sweep/flight_figures.h"
#include <algorithm>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> point_head(const Sweep& sweep) {
  std::vector<std::string> head{"policy"};
  for (const SweepAxis& axis : sweep.plan.axes) {
    head.push_back(axis.key);
  }
  return head;
}

std::vector<std::string> point_fields(const SweepPoint& point) {
  std::vector<std::string> fields{point.policy};
  fields.insert(fields.end(), point.values.begin(), point.values.end());
  return fields;
}

std::string failures_text(const SweepCell& cell) {
  std::string text;
  for (const auto& [failure, count] : cell.failures) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + failure;
  }
  return text;
}

/// The figure of that name as a table shows it.
std::string figure_text(const Sweep& sweep,
                        const SweepCell& cell,
                        const std::string& name,
                        int digits) {
  const auto found = std::find(sweep.figures.begin(), sweep.figures.end(), name);
  if (found == sweep.figures.end()) {
    return "-";
  }
  const auto& value = cell.figures[static_cast<std::size_t>(found - sweep.figures.begin())];
  return value ? rounded(value->median, digits) + " [" + rounded(value->lo, digits) + ", " +
                     rounded(value->hi, digits) + "]"
               : "-";
}

}  // namespace

std::string to_text(const Sweep& sweep) {
  std::vector<std::vector<std::string>> lines{point_head(sweep)};
  for (const char* column : {"ok", "time s", "energy kJ", "battery %", "speed m/s", "latency s",
                             "replans", "failures"}) {
    lines.front().emplace_back(column);
  }
  for (const SweepCell& cell : sweep.cells) {
    std::vector<std::string> line = point_fields(cell.point);
    line.push_back(std::to_string(cell.succeeded) + " of " + std::to_string(cell.n));
    line.push_back(figure_text(sweep, cell, "mission_time_s", 1));
    line.push_back(figure_text(sweep, cell, "energy_total_kj", 1));
    line.push_back(figure_text(sweep, cell, "battery_used_percent", 1));
    line.push_back(figure_text(sweep, cell, "mean_speed_m_s", 2));
    line.push_back(figure_text(sweep, cell, "latency_p50_s", 3));
    line.push_back(figure_text(sweep, cell, "replans", 0));
    line.push_back(failures_text(cell));
    lines.push_back(std::move(line));
  }
  std::string troubles;
  for (const std::string& sentence : troubles_of(sweep)) {
    troubles += sentence + "\n";
  }
  return sweep.plan.scenario + ", seeds " + seeds_text(sweep.plan.seeds) + "\n" + aligned(lines) +
         troubles + "Medians with 95 % bootstrap intervals over succeeded flights.\n";
}

std::string to_json(const Sweep& sweep) {
  Json json{{"scenario", sweep.plan.scenario}, {"seeds", sweep.plan.seeds}};
  json["over"] = Json::array();
  for (const SweepAxis& axis : sweep.plan.axes) {
    json["over"].push_back({{"key", axis.key}, {"values", axis.values}});
  }
  json["cells"] = Json::array();
  for (const SweepCell& cell : sweep.cells) {
    Json figures = Json::object();
    for (std::size_t i = 0; i < cell.figures.size(); ++i) {
      const auto& value = cell.figures[i];
      figures[sweep.figures[i]] =
          value ? Json{{"median", value->median}, {"lo", value->lo}, {"hi", value->hi}} : Json();
    }
    json["cells"].push_back({{"policy", cell.point.policy},
                             {"values", cell.point.values},
                             {"n", cell.n},
                             {"succeeded", cell.succeeded},
                             {"failures", cell.failures},
                             {"command", cell.command},
                             {"figures", std::move(figures)}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string cells_csv(const Sweep& sweep) {
  std::vector<std::string> head = point_head(sweep);
  for (const char* column : {"n", "succeeded", "failures", "command"}) {
    head.emplace_back(column);
  }
  for (const std::string& name : sweep.figures) {
    head.insert(head.end(), {name, name + ".lo", name + ".hi"});
  }
  std::string csv = csv_row(head);
  for (const SweepCell& cell : sweep.cells) {
    std::vector<std::string> fields = point_fields(cell.point);
    fields.insert(fields.end(), {std::to_string(cell.n), std::to_string(cell.succeeded),
                                 failures_text(cell), cell.command});
    for (const auto& value : cell.figures) {
      fields.push_back(value ? csv_number(value->median) : "");
      fields.push_back(value ? csv_number(value->lo) : "");
      fields.push_back(value ? csv_number(value->hi) : "");
    }
    csv += csv_row(fields);
  }
  return csv;
}

std::string flights_csv(const Sweep& sweep) {
  std::vector<std::string> head = point_head(sweep);
  for (const char* column : {"seed", "status", "failure", "trace_hash", "command"}) {
    head.emplace_back(column);
  }
  head.insert(head.end(), sweep.figures.begin(), sweep.figures.end());
  std::string csv = csv_row(head);
  for (const SweepFlight& flight : sweep.flights) {
    const Summary& s = flight.summary;
    std::vector<std::string> fields = point_fields(sweep.cells[flight.point].point);
    fields.insert(fields.end(), {std::to_string(s.seed), std::string{to_string(s.status)},
                                 std::string{to_string(s.failure)}, s.trace_hash, flight.command});
    const auto figures = figures_of(s);
    for (const std::string& name : sweep.figures) {
      const auto found = std::find_if(figures.begin(), figures.end(),
                                      [&name](const auto& figure) { return figure.first == name; });
      fields.push_back(found == figures.end() ? "" : csv_number(found->second));
    }
    csv += csv_row(fields);
  }
  return csv;
}

}  // namespace flyball
