// SPDX-License-Identifier: BSD-3-Clause

#include "studies/plots/line_plot.h"

#include "studies/plots/svg.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>

namespace flyball {
namespace {

constexpr double frame_left_px = 60.0;
constexpr double frame_right_px = 390.0;
constexpr double frame_top_px = 30.0;
constexpr double frame_bottom_px = 260.0;
constexpr double legend_row_px = 16.0;

/// Where each place stands along the axis, in units of the axis; empty when not all are different
/// numbers.
std::vector<double> numbers_of(const std::vector<std::string>& places) {
  std::vector<double> numbers;
  for (const std::string& place : places) {
    char* end = nullptr;
    const double number = std::strtod(place.c_str(), &end);
    if (end == place.c_str() || *end != '\0') {
      return {};
    }
    numbers.push_back(number);
  }
  const bool differ = std::set<double>(numbers.begin(), numbers.end()).size() == numbers.size();
  return differ ? numbers : std::vector<double>{};
}

/// From the lowest end of an interval to the highest one.
svg::Scale heights_of(const LinePlot& plot) {
  if (plot.is_percentage) {
    return svg::around(0.0, 100.0, frame_bottom_px, frame_top_px);
  }
  std::vector<double> ends;
  for (const PlottedLine& line : plot.lines) {
    for (const auto& value : line.values) {
      if (value) {
        ends.insert(ends.end(), {value->lo, value->hi});
      }
    }
  }
  if (ends.empty()) {
    return svg::around(0.0, 1.0, frame_bottom_px, frame_top_px);
  }
  const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
  // At least a twentieth from end to end, so that what hardly differs looks level.
  const double missing = std::max(0.0, 0.05 * std::abs(*high) - (*high - *low));
  return svg::around(*low - 0.5 * missing, *high + 0.5 * missing, frame_bottom_px, frame_top_px);
}

svg::Frame frame_of(const LinePlot& plot, const std::vector<double>& numbers) {
  svg::Frame frame{{}, heights_of(plot)};
  if (numbers.empty()) {
    frame.x = {-0.5, static_cast<double>(plot.places.size()) - 0.5, frame_left_px, frame_right_px};
    return frame;
  }
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  const double margin = *most > *least ? 0.05 * (*most - *least) : 1.0;
  frame.x = {*least - margin, *most + margin, frame_left_px, frame_right_px};
  return frame;
}

/// Lines at the places themselves: these were flown, and nothing between them. Where names
/// would overlap, the first ones stand.
std::string axes_of(const LinePlot& plot, const svg::Frame& frame, const std::vector<double>& at) {
  constexpr double between_px = 4.0;
  std::string content = svg::y_axis(frame);
  std::vector<std::pair<double, double>> named_px;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double x = frame.x.at(at[i]);
    const double reach_px = 0.5 * (svg::width_of(plot.places[i]) + between_px);
    content += svg::line(x, frame_top_px, x, frame_bottom_px, svg::grid);
    const bool has_room = std::none_of(named_px.begin(), named_px.end(), [&](const auto& other) {
      return x - reach_px < other.second && x + reach_px > other.first;
    });
    if (has_room) {
      content += svg::text(x, frame_bottom_px + 16.0, "middle", plot.places[i]);
      named_px.emplace_back(x - reach_px, x + reach_px);
    }
  }
  return content;
}

std::string line_of(const PlottedLine& line,
                    const svg::Frame& frame,
                    const std::vector<double>& at,
                    std::size_t index) {
  const std::string ink = "stroke=\"" + svg::colour(index) + "\"";
  std::string content;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto& value = line.values[i];
    if (!value) {
      continue;
    }
    const double x = frame.x.at(at[i]);
    if (i > 0 && line.values[i - 1]) {
      content += svg::line(frame.x.at(at[i - 1]), frame.y.at(line.values[i - 1]->median), x,
                           frame.y.at(value->median), ink + " stroke-width=\"1.5\"");
    }
    content += svg::line(x, frame.y.at(value->lo), x, frame.y.at(value->hi),
                         ink + " stroke-width=\"2.5\" stroke-opacity=\"0.6\"") +
               svg::dot(x, frame.y.at(value->median), svg::colour(index),
                        svg::interval_text(line.name, *value));
  }
  return content;
}

std::string legend_of(const LinePlot& plot) {
  std::string content;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    const double y = frame_top_px + 8.0 + legend_row_px * static_cast<double>(i);
    content += svg::dot(frame_right_px + 14.0, y, svg::colour(i), plot.lines[i].name) +
               svg::text(frame_right_px + 24.0, y + 4.0, "start", plot.lines[i].name);
  }
  return content;
}

}  // namespace

std::string line_plot_svg(const LinePlot& plot) {
  std::vector<double> at = numbers_of(plot.places);
  const svg::Frame frame = frame_of(plot, at);
  for (std::size_t i = at.size(); i < plot.places.size(); ++i) {
    at.push_back(static_cast<double>(i));
  }
  std::string content = svg::text(0.0, 14.0, "start", plot.title, "font-weight=\"600\"") +
                        axes_of(plot, frame, at) +
                        svg::text(frame_right_px, frame_bottom_px + 34.0, "end", plot.x_title);
  double legend_px = 0.0;
  const bool has_legend = plot.lines.size() > 1;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    content += line_of(plot.lines[i], frame, at, i);
    legend_px = has_legend ? std::max(legend_px, svg::width_of(plot.lines[i].name)) : 0.0;
  }
  const double rows_px = legend_row_px * static_cast<double>(plot.lines.size()) + frame_top_px;
  return svg::picture(frame_right_px + 30.0 + legend_px, std::max(frame_bottom_px + 42.0, rows_px),
                      content + (has_legend ? legend_of(plot) : ""));
}

}  // namespace flyball
