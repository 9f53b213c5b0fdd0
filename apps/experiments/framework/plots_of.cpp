// SPDX-License-Identifier: BSD-3-Clause
// tested-in: figure

#include "experiments/framework/plots_of.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

Point point_of(const Evidence& evidence,
               const PlotOf& wanted,
               const std::vector<std::string>& values,
               const std::string& policy) {
  Point point = evidence.at(wanted.sweep, values, policy);
  point.counts_failed = wanted.counts_failed;
  return point;
}

const std::string& title_of(const AxisLabels& labels, const SweepAxis& axis) {
  return labels.title.empty() ? axis.key : labels.title;
}

const std::vector<std::string>& values_of(const AxisLabels& labels, const SweepAxis& axis) {
  return labels.values.empty() ? axis.values : labels.values;
}

std::vector<std::string> policies_of(const Sweep& sweep, const PlotOf& wanted) {
  return wanted.policy.empty() ? sweep.plan.policies : std::vector{wanted.policy};
}

std::string count_text(const Point& point, const Measured& measured) {
  const auto all = static_cast<int>(point.flights.size());
  return measured.n == all ? "n " + std::to_string(all)
                           : std::to_string(measured.n) + " of " + std::to_string(all);
}

/// At least a twentieth from end to end, so that what hardly differs looks alike.
void set_colours(HeatMap& map) {
  std::vector<double> medians;
  for (const HeatCell& cell : map.cells) {
    if (cell.value) {
      medians.push_back(cell.value->median);
    }
  }
  if (medians.empty()) {
    return;
  }
  const auto [low, high] = std::minmax_element(medians.begin(), medians.end());
  const double least = 0.05 * std::max(std::abs(*low), std::abs(*high));
  const double missing = std::max(0.0, least - (*high - *low));
  map.low = *low - 0.5 * missing;
  map.high = *high + 0.5 * missing;
}

}  // namespace

HeatMap heat_map_of(const Evidence& evidence, const PlotOf& wanted) {
  const Sweep& sweep = evidence.sweep(wanted.sweep);
  const SweepAxis& y = sweep.plan.axes[0];
  const SweepAxis& x = sweep.plan.axes[1];
  HeatMap map{wanted.title,           title_of(wanted.x, x),  title_of(wanted.y, y),
              values_of(wanted.x, x), values_of(wanted.y, y), {}};
  for (const std::string& row : y.values) {
    for (const std::string& column : x.values) {
      const Point point = point_of(evidence, wanted, {row, column}, wanted.policy);
      const Measured measured = median(point, wanted.figure);
      map.cells.push_back({measured.value, count_text(point, measured)});
    }
  }
  set_colours(map);
  return map;
}

LinePlot line_plot_of(const Evidence& evidence, const PlotOf& wanted) {
  const Sweep& sweep = evidence.sweep(wanted.sweep);
  const SweepAxis& x = sweep.plan.axes.back();
  LinePlot plot{wanted.title, title_of(wanted.x, x), values_of(wanted.x, x), {}};
  // With one axis there is one line for each policy.
  const bool has_lines = sweep.plan.axes.size() > 1;
  const std::vector<std::string> lines =
      has_lines ? sweep.plan.axes.front().values : std::vector<std::string>{""};
  for (const std::string& policy : policies_of(sweep, wanted)) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string name = has_lines ? values_of(wanted.y, sweep.plan.axes.front())[i] : policy;
      PlottedLine line{name, {}};
      for (const std::string& value : x.values) {
        const auto values = has_lines ? std::vector{lines[i], value} : std::vector{value};
        line.values.push_back(
            median(point_of(evidence, wanted, values, policy), wanted.figure).value);
      }
      plot.lines.push_back(std::move(line));
    }
  }
  return plot;
}

std::string counts_text(const Evidence& evidence, const PlotOf& wanted) {
  const Sweep& sweep = evidence.sweep(wanted.sweep);
  std::vector<int> counts;
  for (const SweepCell& cell : sweep.cells) {
    if (wanted.policy.empty() || wanted.policy == cell.point.policy) {
      const Point point = point_of(evidence, wanted, cell.point.values, cell.point.policy);
      counts.push_back(median(point, wanted.figure).n);
    }
  }
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  return "Each value: " +
         (*least == *most ? std::to_string(*most)
                          : std::to_string(*least) + " to " + std::to_string(*most)) +
         (*most == 1 ? " flight" : " flights") + "; lines reach from end to end of the interval.";
}

Figure policies_plot(const Evidence& evidence,
                     const std::string& sweep,
                     const std::string& figure,
                     const std::string& title) {
  DotPlot plot{title, {}};
  for (const std::string& policy : evidence.sweep(sweep).plan.policies) {
    plot.values.push_back(
        {policy, median(evidence.at(sweep, {}, policy), flight_figure(figure)).value});
  }
  return {figure, "Median with interval over the flights that succeed.", plot};
}

}  // namespace flyball
