// SPDX-License-Identifier: BSD-3-Clause
// tested-in: dot_plot

#include "studies/plots/svg.h"

#include "flyball/records/text_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flyball::svg {
namespace {

constexpr std::array<const char*, 8> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#7a5cad", "#444444"};

std::string px(double value) {
  return rounded(value, 1);
}

}  // namespace

std::string colour(std::size_t i) {
  return palette[i % palette.size()];
}

std::string text(double x,
                 double y,
                 const std::string& anchor,
                 const std::string& content,
                 const std::string& look) {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\" " + look +
         ">" + html_text(content) + "</text>";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& look) {
  return "<line x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) +
         "\" " + look + "/>";
}

std::string dot(double x, double y, const std::string& fill, const std::string& title) {
  return "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"4.5\" fill=\"" + fill +
         "\"><title>" + html_text(title) + "</title></circle>";
}

std::string rectangle(const Box& box, const std::string& look, const std::string& title) {
  return "<rect x=\"" + px(box.x) + "\" y=\"" + px(box.y) + "\" width=\"" + px(box.width) +
         "\" height=\"" + px(box.height) + "\" " + look + "><title>" + html_text(title) +
         "</title></rect>";
}

std::string picture(double width, double height, const std::string& content) {
  return "<svg viewBox=\"0 0 " + px(width) + " " + px(height) + "\" width=\"" + px(width) +
         "\" height=\"" + px(height) + "\" role=\"img\">" + content + "</svg>\n";
}

double tick_step(double span) {
  const double rough = std::max(span, 1e-9) / 4.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  constexpr double nearly = 1.42;  // Square root of 2: the nearer one of 1, 2, 5 and 10, in ratio.
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * nearly >= rough) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

std::vector<double> ticks(const Scale& scale) {
  const double span = scale.high - scale.low;
  if (!std::isfinite(span)) {  // Its step is infinite, too, or none: adding it would get nowhere.
    return {};
  }
  const double step = tick_step(span);
  std::vector<double> all;
  for (double tick = std::ceil(scale.low / step) * step; tick <= scale.high; tick += step) {
    all.push_back(tick);
  }
  return all;
}

std::string number(double value, double step) {
  const int digits = static_cast<int>(std::max(0.0, std::ceil(-std::log10(step) - 1e-9)));
  return rounded(value, digits);
}

Scale around(double low, double high, double from_px, double to_px) {
  const double margin = 0.08 * std::max(high - low, 0.02 * std::max(std::abs(high), 1e-9));
  return {std::max(0.0, low - margin), high + margin, from_px, to_px};
}

double width_of(const std::string& text) {
  constexpr double letter_px = 6.8;
  return letter_px * static_cast<double>(letters_in(text));
}

std::string axes(const Frame& frame) {
  const auto& [x, y] = frame;
  std::string content;
  const double step_x = tick_step(x.high - x.low);
  for (const double tick : ticks(x)) {
    content += line(x.at(tick), y.to_px, x.at(tick), y.from_px, grid) +
               text(x.at(tick), y.from_px + 16.0, "middle", number(tick, step_x));
  }
  return content + y_axis(frame);
}

std::string y_axis(const Frame& frame) {
  const auto& [x, y] = frame;
  std::string content;
  const double step_y = tick_step(y.high - y.low);
  for (const double tick : ticks(y)) {
    content += line(x.from_px, y.at(tick), x.to_px, y.at(tick), grid) +
               text(x.from_px - 6.0, y.at(tick) + 4.0, "end", number(tick, step_y));
  }
  return content;
}

std::string interval_text(const std::string& name, const MedianInterval& value) {
  return name + ": " + rounded(value.median, 2) + " [" + rounded(value.lo, 2) + ", " +
         rounded(value.hi, 2) + "]";
}

}  // namespace flyball::svg
