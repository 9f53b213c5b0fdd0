// SPDX-License-Identifier: BSD-3-Clause

#include "studies/plots/dot_plot.h"

#include "flyball/records/text_table.h"

#include "studies/plots/svg.h"
#include <algorithm>
#include <numeric>

namespace flyball {
namespace {

using svg::around;
using svg::axes;
using svg::colour;
using svg::dot;
using svg::Frame;
using svg::grid;
using svg::interval_text;
using svg::line;
using svg::number;
using svg::Scale;
using svg::text;
using svg::tick_step;

constexpr double left_px = 60.0;
constexpr double right_px = 640.0;
constexpr double top_px = 30.0;  // Above it stands the title of the vertical axis.
constexpr double bottom_px = 330.0;
constexpr double name_row_px = 15.0;

Frame frame_around(const std::vector<PlottedPoint>& points) {
  MedianInterval x = points[0].x;
  MedianInterval y = points[0].y;
  for (const PlottedPoint& point : points) {
    x = {0.0, std::min(x.lo, point.x.lo), std::max(x.hi, point.x.hi)};
    y = {0.0, std::min(y.lo, point.y.lo), std::max(y.hi, point.y.hi)};
  }
  return {around(x.lo, x.hi, left_px, right_px), around(y.lo, y.hi, bottom_px, top_px)};
}

/// The best points, joined.
std::string front_of(const Frame& frame, const std::vector<PlottedPoint>& points) {
  std::vector<const PlottedPoint*> front;
  for (const PlottedPoint& point : points) {
    if (point.is_best) {
      front.push_back(&point);
    }
  }
  std::sort(front.begin(), front.end(),
            [](const PlottedPoint* a, const PlottedPoint* b) { return a->x.median < b->x.median; });
  std::string content;
  for (std::size_t i = 1; i < front.size(); ++i) {
    content += line(frame.x.at(front[i - 1]->x.median), frame.y.at(front[i - 1]->y.median),
                    frame.x.at(front[i]->x.median), frame.y.at(front[i]->y.median),
                    "stroke=\"#6b7a88\" stroke-dasharray=\"4 3\"");
  }
  return content;
}

std::string cross(const Frame& frame,
                  const PlottedPoint& point,
                  const std::string& ink,
                  const std::string& x_title) {
  const double x = frame.x.at(point.x.median);
  const double y = frame.y.at(point.y.median);
  const std::string look = "stroke-width=\"2\" stroke=\"" + ink + "\"";
  return line(frame.x.at(point.x.lo), y, frame.x.at(point.x.hi), y, look) +
         line(x, frame.y.at(point.y.lo), x, frame.y.at(point.y.hi), look) +
         dot(x, y, ink, interval_text(point.name + ", " + x_title, point.x));
}

/// A name beside the frame, in a row of its own and joined to its point by a line, because points
/// may lie on each other.
std::string names_of(const Frame& frame, const std::vector<PlottedPoint>& points) {
  std::vector<std::size_t> by_height(points.size());
  std::iota(by_height.begin(), by_height.end(), 0U);
  const auto height_px = [&](std::size_t i) { return frame.y.at(points[i].y.median); };
  std::stable_sort(by_height.begin(), by_height.end(),
                   [&](std::size_t a, std::size_t b) { return height_px(a) < height_px(b); });
  std::string content;
  double free_px = top_px;
  double rows_below = static_cast<double>(points.size());
  for (const std::size_t i : by_height) {
    const double lowest_px = std::max(free_px, bottom_px - name_row_px * --rows_below);
    const double y = std::clamp(height_px(i), free_px, lowest_px);
    content += line(frame.x.at(points[i].x.median), height_px(i), right_px + 10.0, y,
                    "stroke-width=\"0.7\" stroke=\"" + colour(i) + "\"") +
               text(right_px + 14.0, y + 4.0, "start", points[i].name);
    free_px = y + name_row_px;
  }
  return content;
}

/// Width of the longest name.
template <class Named>
double longest_px(const std::vector<Named>& all) {
  double most_px = 0.0;
  for (const Named& one : all) {
    most_px = std::max(most_px, svg::width_of(one.name));
  }
  return most_px;
}

}  // namespace

std::string dot_plot_svg(const std::string& title, const std::vector<PlottedValue>& values) {
  constexpr double row_px = 22.0;
  const double names_px = std::max(150.0, longest_px(values) + 12.0);
  const double width_px = names_px + 300.0;
  double high = 0.0;
  for (const PlottedValue& value : values) {
    high = value.value ? std::max(high, value.value->hi) : high;
  }
  const Scale x{0.0, high > 0.0 ? 1.05 * high : 1.0, names_px, width_px - 20.0};
  const double foot_px = 30.0 + row_px * static_cast<double>(values.size());
  std::string content =
      "<text x=\"0\" y=\"14\" font-weight=\"600\">" + html_text(title) + "</text>";
  const double step = tick_step(x.high);
  for (const double tick : svg::ticks(x)) {
    content += line(x.at(tick), 24.0, x.at(tick), foot_px, grid) +
               text(x.at(tick), foot_px + 14.0, "middle", number(tick, step));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double y = 38.0 + row_px * static_cast<double>(i);
    content += text(names_px - 8.0, y + 4.0, "end", values[i].name);
    if (const auto& value = values[i].value) {
      content += line(x.at(value->lo), y, x.at(value->hi), y,
                      "stroke-width=\"2.5\" stroke=\"" + colour(i) + "\"") +
                 dot(x.at(value->median), y, colour(i), interval_text(values[i].name, *value));
    } else {
      content += text(x.at(0.0) + 4.0, y + 4.0, "start", "no flight succeeded");
    }
  }
  return svg::picture(std::max(width_px, svg::width_of(title)), foot_px + 20.0, content);
}

void mark_best(std::vector<PlottedPoint>& points) {
  for (PlottedPoint& point : points) {
    point.is_best = std::none_of(points.begin(), points.end(), [&point](const PlottedPoint& other) {
      const bool no_worse = other.x.median <= point.x.median && other.y.median <= point.y.median;
      const bool better = other.x.median < point.x.median || other.y.median < point.y.median;
      return no_worse && better;
    });
  }
}

std::string pareto_plot_svg(const std::string& x_title,
                            const std::string& y_title,
                            std::vector<PlottedPoint> points) {
  if (points.empty()) {
    return "<p class=\"note\">No flight succeeded.</p>\n";
  }
  mark_best(points);
  const Frame frame = frame_around(points);
  std::string content = text(right_px, bottom_px + 36.0, "end", x_title) +
                        text(4.0, 14.0, "start", y_title) + axes(frame) + front_of(frame, points);
  content += names_of(frame, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    content += cross(frame, points[i], colour(i), x_title);
  }
  const double names_end_px = top_px + name_row_px * static_cast<double>(points.size());
  return svg::picture(right_px + 24.0 + longest_px(points),
                      std::max(bottom_px + 42.0, names_end_px), content);
}

}  // namespace flyball
