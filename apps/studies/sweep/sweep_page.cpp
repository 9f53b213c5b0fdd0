// SPDX-License-Identifier: BSD-3-Clause
// tested-in: sweep

#include "flyball/records/text_table.h"
#include "flyball/studies/comparison.h"
#include "flyball/studies/sweep.h"

#include "studies/plots/heat_map.h"
#include "studies/plots/line_plot.h"
#include "studies/plots/page.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

/// What a plot shows of a cell.
struct Shown {
  std::string title;
  bool is_percentage{};                               ///< Then colours, axes reach from 0 to 100.
  std::vector<std::optional<MedianInterval>> values;  ///< One for each cell of the sweep.
};

std::string count_text(const SweepCell& cell) {
  return cell.succeeded == cell.n
             ? "n " + std::to_string(cell.n)
             : std::to_string(cell.succeeded) + " of " + std::to_string(cell.n) + " fly";
}

/// Least and greatest median; empty where no cell has one.
std::optional<std::pair<double, double>> range_of(const Shown& shown) {
  std::optional<std::pair<double, double>> range;
  for (const auto& value : shown.values) {
    if (value) {
      range = range ? std::pair{std::min(range->first, value->median),
                                std::max(range->second, value->median)}
                    : std::pair{value->median, value->median};
    }
  }
  return range;
}

Shown success_of(const Sweep& sweep) {
  Shown shown{"flights that succeed, %", true, {}};
  for (const SweepCell& cell : sweep.cells) {
    const double share = cell.n == 0 ? 0.0 : 100.0 * cell.succeeded / cell.n;
    shown.values.push_back(MedianInterval{share, share, share});
  }
  return shown;
}

Shown figure_of(const Sweep& sweep, std::size_t figure) {
  Shown shown{sweep.figures[figure], false, {}};
  for (const SweepCell& cell : sweep.cells) {
    shown.values.push_back(cell.figures[figure]);
  }
  return shown;
}

/// How many neighbouring points have the same policy and the same values of all axes but the last
/// two: one heat map. (With one axis: one line.)
std::size_t group_size(const Sweep& sweep) {
  const auto& axes = sweep.plan.axes;
  return axes.back().values.size() * (axes.size() > 1 ? axes[axes.size() - 2].values.size() : 1);
}

/// `mission_energy, camera.rate_hz=10`: what all cells of a heat map have in common.
std::string group_name(const Sweep& sweep, const SweepPoint& point) {
  std::string name = point.policy;
  for (std::size_t i = 0; i + 2 < sweep.plan.axes.size(); ++i) {
    name += ", " + sweep.plan.axes[i].key + "=" + point.values[i];
  }
  return name;
}

std::string lines_of(const Sweep& sweep, const Shown& shown) {
  const SweepAxis& axis = sweep.plan.axes.front();
  LinePlot plot{shown.title, axis.key, axis.values, {}, shown.is_percentage};
  for (std::size_t from = 0; from < sweep.cells.size(); from += axis.values.size()) {
    const auto first = shown.values.begin() + static_cast<std::ptrdiff_t>(from);
    plot.lines.push_back({sweep.cells[from].point.policy,
                          {first, first + static_cast<std::ptrdiff_t>(axis.values.size())}});
  }
  return line_plot_svg(plot);
}

/// The ends of the colours: at least a twentieth apart, so that what hardly differs looks alike.
std::pair<double, double> colours_of(const std::pair<double, double>& range) {
  constexpr double least_share = 0.05;
  const double least = least_share * std::max(std::abs(range.first), std::abs(range.second));
  const double missing = std::max(0.0, least - (range.second - range.first));
  return {range.first - 0.5 * missing, range.second + 0.5 * missing};
}

std::string heat_maps_of(const Sweep& sweep, const Shown& shown) {
  const SweepAxis& y = sweep.plan.axes[sweep.plan.axes.size() - 2];
  const SweepAxis& x = sweep.plan.axes.back();
  const auto [low, high] =
      shown.is_percentage ? std::pair{0.0, 100.0} : colours_of(*range_of(shown));
  std::string content;
  for (std::size_t from = 0; from < sweep.cells.size(); from += group_size(sweep)) {
    HeatMap map{shown.title + ": " + group_name(sweep, sweep.cells[from].point),
                x.key,
                y.key,
                x.values,
                y.values,
                {},
                low,
                high};
    for (std::size_t i = from; i < from + group_size(sweep); ++i) {
      map.cells.push_back({shown.values[i], count_text(sweep.cells[i])});
    }
    content += heat_map_svg(map);
  }
  return content;
}

std::string plots_of(const Sweep& sweep, const Shown& shown) {
  return sweep.plan.axes.size() == 1 ? lines_of(sweep, shown) : heat_maps_of(sweep, shown);
}

std::string commands_html(const Sweep& sweep) {
  std::string rows = "<tr><th>policy</th>";
  for (const SweepAxis& axis : sweep.plan.axes) {
    rows += "<th>" + html_text(axis.key) + "</th>";
  }
  rows += "<th>flights that succeed</th><th style=\"text-align:left\">command</th></tr>\n";
  for (const SweepCell& cell : sweep.cells) {
    rows += "<tr><td>" + html_text(cell.point.policy) + "</td>";
    for (const std::string& value : cell.point.values) {
      rows += "<td>" + html_text(value) + "</td>";
    }
    std::string failures;
    for (const auto& [failure, count] : cell.failures) {
      failures += "<small>" + std::to_string(count) + " " + html_text(failure) + "</small>";
    }
    rows += "<td>" + std::to_string(cell.succeeded) + " of " + std::to_string(cell.n) + failures +
            "</td><td style=\"text-align:left\"><code>" + html_text(cell.command) +
            "</code></td></tr>\n";
  }
  return "<h2>The command of each cell</h2>\n<div class=\"panel\">" + html_table(rows) + "</div>\n";
}

}  // namespace

std::string sweep_page(const Sweep& sweep) {
  const std::string seeds = seeds_text(sweep.plan.seeds);
  std::string page = page_begin("Sweep of " + sweep.plan.scenario) + "<p>Seeds " +
                     html_text(seeds) +
                     ". Each cell shows the median over its succeeded flights, its 95 % interval "
                     "and how many there are.</p>\n" +
                     "<div class=\"panel plots\">" + plots_of(sweep, success_of(sweep));
  std::string same;
  for (std::size_t i = 0; i < sweep.figures.size(); ++i) {
    const Shown shown = figure_of(sweep, i);
    const auto range = range_of(shown);
    if (range && range->first < range->second) {
      page += plots_of(sweep, shown);
    } else if (range) {
      same += (same.empty() ? "" : ", ") + sweep.figures[i] + " " +
              rounded(range->first, digits_for(0.0, range->first));
    }
  }
  page += "</div>\n";
  if (!same.empty()) {
    page +=
        "<p class=\"note\">Medians that are the same in every cell: " + html_text(same) + ".</p>\n";
  }
  for (const std::string& sentence : troubles_of(sweep)) {
    page += "<p class=\"note\">" + html_text(sentence) + "</p>\n";
  }
  return page + commands_html(sweep) +
         page_end(
             "Medians with 95 % bootstrap intervals over succeeded flights. Flights are "
             "simulated in closed loop on a modeled computer.");
}

}  // namespace flyball
