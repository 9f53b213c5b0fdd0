// SPDX-License-Identifier: BSD-3-Clause
// tested-in: tournament

#include "flyball/records/text_table.h"
#include "flyball/studies/tournament.h"

#include "studies/plots/dot_plot.h"
#include "studies/plots/page.h"
#include <algorithm>

namespace flyball {
namespace {

std::optional<MedianInterval> scaled(const std::optional<MedianInterval>& value, double by) {
  if (!value) {
    return std::nullopt;
  }
  return MedianInterval{value->median * by, value->lo * by, value->hi * by};
}

std::string cell(const std::optional<MedianInterval>& value, double scale, int digits) {
  if (!value) {
    return "<td>-</td>";
  }
  const auto show = [&](double x) { return rounded(x * scale, digits); };
  return "<td>" + show(value->median) + "<small>[" + show(value->lo) + ", " + show(value->hi) +
         "]</small></td>";
}

std::string differences_html(const std::string& head,
                             const std::vector<PairedDifference>& differences,
                             bool names_both) {
  if (differences.empty()) {
    return {};
  }
  std::string table =
      "<h3>" + html_text(head) +
      ", seed by seed</h3><div class=\"table\"><table><tr><th>policy</th><th>pairs</th><th>less "
      "energy in</th><th>time "
      "s</th><th>energy kJ</th><th>energy %</th><th>computer %</th><th>battery %</th></tr>\n";
  for (const PairedDifference& d : differences) {
    table += "<tr><td>" + html_text(names_both ? d.name() : d.policy) + "</td><td>" +
             std::to_string(d.pairs) + "</td><td>" + std::to_string(d.wins) + "</td>" +
             cell(d.time_s, 1.0, 1) + cell(d.energy_j, 1e-3, 1) + cell(d.energy_percent, 1.0, 1) +
             cell(d.computer_percent, 1.0, 1) + cell(d.battery_percent, 1.0, 1) + "</tr>\n";
  }
  return table + "</table></div>\n";
}

std::string bounds_html(const WorldResult& world) {
  if (world.latency_bounds.empty()) {
    return {};
  }
  std::string table =
      "<h3>Latency bounds</h3><div class=\"table\"><table><tr><th>policy</th><th>cells "
      "m</th><th>issued</th>"
      "<th>late</th><th>late %</th><th>at most %</th></tr>\n";
  for (const BoundFigures& level : world.latency_bounds) {
    const auto most = level.most_percent();
    table += "<tr><td>" + html_text(level.policy) + "</td><td>" + rounded(level.resolution_m, 2) +
             "</td><td>" + std::to_string(level.issued) + "</td><td>" + std::to_string(level.late) +
             "</td><td>" + rounded(level.late_percent(), 1) + "</td><td>" +
             (most ? rounded(*most, 1) : "-") + "</td></tr>\n";
  }
  return table +
         "</table></div>\n<p class=\"note\">At most: the share asked for and the slack of a bound "
         "that "
         "calibrates itself, where no map takes over four times what was predicted.</p>\n";
}

std::string decisions_html(const WorldResult& world) {
  const bool has_bound = world.has_bound();
  std::string table =
      "<h3>Decisions</h3><div class=\"table\"><table><tr><th>policy</th><th>maps later than "
      "bounded %</th><th>budget "
      "use</th>";
  const bool has_heat = world.has_heat();
  table += has_bound ? "<th>energy over its bound</th>" : "";
  table += has_heat ? "<th>times throttled</th></tr>\n" : "</tr>\n";
  for (const DecisionFigures& d : world.decisions) {
    table += "<tr><td>" + html_text(d.policy) + "</td>" + cell(d.overrun_percent, 1.0, 2) +
             cell(d.budget_use, 1.0, 2) + (has_bound ? cell(d.over_bound, 1.0, 2) : "") +
             (has_heat ? "<td>" + (d.throttle_events ? std::to_string(*d.throttle_events) : "-") +
                             "</td>"
                       : "") +
             "</tr>\n";
  }
  return table + "</table></div>\n";
}

/// A count is exact: its interval is the count itself.
MedianInterval exactly(double value) {
  return {value, value, value};
}

std::string plots_of(const WorldResult& world) {
  const auto& rows = world.comparison.rows;
  const auto plot = [&](const std::string& title, const auto& value_of) {
    std::vector<PlottedValue> values;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      values.push_back({rows[i].policy, value_of(i)});
    }
    return dot_plot_svg(title, values);
  };
  return plot("mission time, s", [&](std::size_t i) { return rows[i].mission_time_s; }) +
         plot("energy, kJ", [&](std::size_t i) { return scaled(rows[i].energy_total_j, 1e-3); }) +
         plot("battery, %", [&](std::size_t i) { return rows[i].battery_used_percent; }) +
         plot("maps later than bounded, %",
              [&](std::size_t i) { return world.decisions[i].overrun_percent; }) +
         plot("latency over its bound",
              [&](std::size_t i) { return world.decisions[i].budget_use; }) +
         plot("decision time on the host, 99 % within, us",
              [&](std::size_t i) { return world.decisions[i].decision_us; }) +
         plot("collisions",
              [&](std::size_t i) {
                return std::optional{exactly(static_cast<double>(rows[i].collisions))};
              }) +
         plot("flights that failed", [&](std::size_t i) {
           return std::optional{exactly(static_cast<double>(rows[i].n - rows[i].succeeded))};
         });
}

std::string pareto_of(const WorldResult& world) {
  std::vector<PlottedPoint> points;
  for (const ComparisonRow& row : world.comparison.rows) {
    if (row.mission_time_s && row.energy_total_j) {
      points.push_back({row.policy, *row.mission_time_s, *scaled(row.energy_total_j, 1e-3)});
    }
  }
  return pareto_plot_svg("mission time, s", "energy, kJ", std::move(points));
}

std::string hindsight_html(const WorldResult& world) {
  return world.hindsight
             ? "<p class=\"note\">fixed_best: " + html_text(world.hindsight->text()) + ".</p>\n"
             : std::string{};
}

std::string world_html(const WorldResult& world) {
  return "<h2>" + html_text(world.comparison.scenario) + "</h2>\n<div class=\"panel\">" +
         to_html(world.comparison) + hindsight_html(world) +
         differences_html("Difference from " + world.comparison.rows.front().policy,
                          world.differences, false) +
         differences_html("Pairs", world.pairs, true) + decisions_html(world) + bounds_html(world) +
         "</div>\n<div class=\"panel\"><h3>Energy over time; dashed: what nothing beats in "
         "both</h3>" +
         pareto_of(world) + "</div>\n<div class=\"panel plots\">" + plots_of(world) + "</div>\n";
}

const PairedDifference* pair_in(const WorldResult& world, const PairedDifference& pair) {
  for (const PairedDifference& other : world.pairs) {
    if (other.policy == pair.policy && other.to == pair.to) {
      return &other;
    }
  }
  return nullptr;
}

/// One of each name, in the order in which they first stand.
std::vector<PairedDifference> pairs_in(const std::vector<WorldResult>& worlds) {
  std::vector<PairedDifference> pairs;
  for (const WorldResult& world : worlds) {
    for (const PairedDifference& pair : world.pairs) {
      const bool is_known = std::any_of(pairs.begin(), pairs.end(), [&](const auto& known) {
        return known.name() == pair.name();
      });
      if (!is_known) {
        pairs.push_back(pair);
      }
    }
  }
  return pairs;
}

std::string pair_cell(const PairedDifference* here) {
  return here == nullptr || !here->energy_percent
             ? "<td>-</td>"
             : "<td>" + rounded(here->energy_percent->median, 1) + "<small>" +
                   (here->computer_percent ? rounded(here->computer_percent->median, 1) : "-") +
                   "</small></td>";
}

/// The pairs that were asked for over all worlds: when it pays, and when not.
std::string pairs_over_worlds(const std::vector<WorldResult>& worlds) {
  const std::vector<PairedDifference> pairs = pairs_in(worlds);
  if (pairs.empty()) {
    return {};
  }
  std::string head;
  for (const WorldResult& world : worlds) {
    head += "<th>" + html_text(world.comparison.scenario) + "</th>";
  }
  std::string table =
      "<h2>Pairs over all worlds</h2>\n<div class=\"panel\"><div "
      "class=\"table\"><table><tr><th>energy "
      "%, below it the computer's</th>" +
      head + "</tr>\n";
  for (const PairedDifference& pair : pairs) {
    table += "<tr><td>" + html_text(pair.name()) + "</td>";
    for (const WorldResult& world : worlds) {
      table += pair_cell(pair_in(world, pair));
    }
    table += "</tr>\n";
  }
  return table + "</table></div></div>\n";
}

}  // namespace

std::string tournament_page(const std::string& title,
                            const std::vector<WorldResult>& worlds,
                            const std::string& summary) {
  std::string page = page_begin(title) + summary + pairs_over_worlds(worlds);
  for (const WorldResult& world : worlds) {
    page += world_html(world);
  }
  return page + page_end(
                    "Medians with 95 % bootstrap intervals over succeeded flights. Flights are "
                    "simulated in closed loop on a modeled computer. The guard prevents collisions "
                    "as long as obstacles stand still, the map is sound and the brake model "
                    "holds.");
}

}  // namespace flyball
