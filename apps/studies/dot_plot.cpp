// SPDX-License-Identifier: BSD-3-Clause

#include "studies/dot_plot.h"

#include "flyball/records/text_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace flyball {
namespace {

constexpr std::array<const char*, 8> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#7a5cad", "#444444"};

std::string colour(std::size_t i) {
  return palette[i % palette.size()];
}

std::string px(double value) {
  return rounded(value, 1);
}

std::string text(double x, double y, const std::string& anchor, const std::string& content) {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\">" +
         html_text(content) + "</text>";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& look) {
  return "<line x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) +
         "\" " + look + "/>";
}

std::string dot(double x, double y, const std::string& fill, const std::string& title) {
  return "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"4.5\" fill=\"" + fill +
         "\"><title>" + html_text(title) + "</title></circle>";
}

std::string svg(double width, double height, const std::string& content) {
  return "<svg viewBox=\"0 0 " + px(width) + " " + px(height) + "\" width=\"" + px(width) +
         "\" height=\"" + px(height) + "\" role=\"img\">" + content + "</svg>\n";
}

/// Ticks at 1, 2 or 5 times a power of ten, about four of them.
double tick_step(double span) {
  const double rough = std::max(span, 1e-9) / 4.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

std::string number(double value, double step) {
  const int digits = static_cast<int>(std::max(0.0, std::ceil(-std::log10(step) - 1e-9)));
  return rounded(value, digits);
}

/// From values to places along one axis.
struct Scale {
  double low{};
  double high{1.0};
  double from_px{};
  double to_px{};
  [[nodiscard]] double at(double value) const {
    return from_px + (to_px - from_px) * (value - low) / (high - low);
  }
};

Scale around(double low, double high, double from_px, double to_px) {
  const double margin = 0.08 * std::max(high - low, 0.02 * std::max(std::abs(high), 1e-9));
  return {std::max(0.0, low - margin), high + margin, from_px, to_px};
}

constexpr const char* grid = "stroke=\"#dfe5ea\"";

std::string interval_text(const std::string& name, const MedianInterval& value) {
  return name + ": " + rounded(value.median, 2) + " [" + rounded(value.lo, 2) + ", " +
         rounded(value.hi, 2) + "]";
}

constexpr double left_px = 60.0;
constexpr double right_px = 640.0;
constexpr double top_px = 20.0;
constexpr double bottom_px = 330.0;
constexpr double name_row_px = 15.0;

struct Frame {
  Scale x{};
  Scale y{};
};

Frame frame_around(const std::vector<PlottedPoint>& points) {
  MedianInterval x = points[0].x;
  MedianInterval y = points[0].y;
  for (const PlottedPoint& point : points) {
    x = {0.0, std::min(x.lo, point.x.lo), std::max(x.hi, point.x.hi)};
    y = {0.0, std::min(y.lo, point.y.lo), std::max(y.hi, point.y.hi)};
  }
  return {around(x.lo, x.hi, left_px, right_px), around(y.lo, y.hi, bottom_px, top_px)};
}

std::string axes(const Frame& frame) {
  const auto& [x, y] = frame;
  std::string content;
  const double step_x = tick_step(x.high - x.low);
  for (double tick = std::ceil(x.low / step_x) * step_x; tick <= x.high; tick += step_x) {
    content += line(x.at(tick), top_px, x.at(tick), bottom_px, grid) +
               text(x.at(tick), bottom_px + 16.0, "middle", number(tick, step_x));
  }
  const double step_y = tick_step(y.high - y.low);
  for (double tick = std::ceil(y.low / step_y) * step_y; tick <= y.high; tick += step_y) {
    content += line(left_px, y.at(tick), right_px, y.at(tick), grid) +
               text(left_px - 6.0, y.at(tick) + 4.0, "end", number(tick, step_y));
  }
  return content;
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

/// Width of the longest name, in the page's type.
template <class Named>
double longest_px(const std::vector<Named>& all) {
  constexpr double letter_px = 6.8;
  std::size_t most = 0;
  for (const Named& one : all) {
    most = std::max(most, one.name.size());
  }
  return letter_px * static_cast<double>(most);
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
  for (double tick = 0.0; tick <= x.high; tick += step) {
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
  return svg(width_px, foot_px + 20.0, content);
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
  return svg(right_px + 24.0 + longest_px(points), std::max(bottom_px + 42.0, names_end_px),
             content);
}

}  // namespace flyball
