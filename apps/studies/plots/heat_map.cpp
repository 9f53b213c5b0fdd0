// SPDX-License-Identifier: BSD-3-Clause

#include "studies/plots/heat_map.h"

#include "flyball/records/text_table.h"

#include "studies/plots/svg.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace flyball {
namespace {

struct Rgb {
  double r{};
  double g{};
  double b{};
};

/// Lightness falls all along, so that the map reads in grey as well. Five points of viridis
/// (Smith and van der Walt 2015, CC0), from its light end.
constexpr std::array<Rgb, 5> ramp{{{253.0, 231.0, 37.0},
                                   {94.0, 201.0, 98.0},
                                   {33.0, 145.0, 140.0},
                                   {59.0, 82.0, 139.0},
                                   {68.0, 1.0, 84.0}}};

constexpr double cell_width_px = 92.0;
constexpr double cell_height_px = 52.0;
constexpr double first_row_px = 44.0;
constexpr double dark_from = 0.45;  // Of the ramp: white reads better there than black.

std::string fill_of(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
  const double t = place - static_cast<double>(lower);
  const auto mix = [t](double from, double to) {
    return std::to_string(std::lround(from + t * (to - from)));
  };
  return "rgb(" + mix(ramp[lower].r, ramp[lower + 1].r) + "," +
         mix(ramp[lower].g, ramp[lower + 1].g) + "," + mix(ramp[lower].b, ramp[lower + 1].b) + ")";
}

/// Where the value stands between the map's ends.
double share_of(const HeatMap& map, double value) {
  return map.high > map.low ? (value - map.low) / (map.high - map.low) : 0.0;
}

std::string cell_svg(const HeatMap& map, const HeatCell& cell, double x, double y) {
  const double middle = x + 0.5 * cell_width_px;
  if (!cell.value) {
    return svg::rectangle({x, y, cell_width_px, cell_height_px}, "fill=\"#eef1f4\" stroke=\"#fff\"",
                          cell.under) +
           svg::text(middle, y + 22.0, "middle", "none") +
           svg::text(middle, y + 38.0, "middle", cell.under);
  }
  const int digits = digits_for(map.low, map.high);
  const double share = share_of(map, cell.value->median);
  const std::string ink = share > dark_from ? "style=\"fill:#fff\"" : "style=\"fill:#111\"";
  const std::string small = share > dark_from ? "style=\"fill:#fff;font-size:10px\""
                                              : "style=\"fill:#111;font-size:10px\"";
  const bool has_interval = cell.value->lo < cell.value->hi;  // Not of one flight or equal ones.
  const std::string interval = has_interval ? "[" + rounded(cell.value->lo, digits) + ", " +
                                                  rounded(cell.value->hi, digits) + "]"
                                            : "";
  return svg::rectangle({x, y, cell_width_px, cell_height_px},
                        "fill=\"" + fill_of(share) + "\" stroke=\"#fff\"",
                        svg::interval_text(map.title, *cell.value) + ", " + cell.under) +
         svg::text(middle, y + 18.0, "middle", rounded(cell.value->median, digits), ink) +
         svg::text(middle, y + 32.0, "middle", interval, small) +
         svg::text(middle, y + 45.0, "middle", cell.under, small);
}

/// The colours beside the map, with the values at both ends.
std::string legend(const HeatMap& map, double x, double height) {
  constexpr int steps = 24;
  const int digits = digits_for(map.low, map.high);
  const double step_px = height / steps;
  std::string content;
  for (int i = 0; i < steps; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / steps;
    content += svg::rectangle({x, first_row_px + height - (i + 1) * step_px, 12.0, step_px + 0.3},
                              "fill=\"" + fill_of(share) + "\"", "");
  }
  return content + svg::text(x + 18.0, first_row_px + 10.0, "start", rounded(map.high, digits)) +
         svg::text(x + 18.0, first_row_px + height, "start", rounded(map.low, digits));
}

}  // namespace

int digits_for(double low, double high) {
  constexpr double told_apart = 200.0;  // So many values of one span are told apart.
  constexpr int most_that_count = 4;
  const double size = std::max(std::abs(low), std::abs(high));
  const double span = high > low ? high - low : size;
  if (!(span > 0.0)) {
    return 0;
  }
  const int before_point = 1 + static_cast<int>(std::floor(std::log10(size)));
  const int wanted = static_cast<int>(std::ceil(-std::log10(span / told_apart)));
  return std::clamp(wanted, 0, std::max(0, most_that_count - before_point));
}

std::string heat_map_svg(const HeatMap& map) {
  double names_px = 0.0;
  for (const std::string& value : map.y_values) {
    names_px = std::max(names_px, svg::width_of(value));
  }
  const double left_px = names_px + 34.0;
  const double height = cell_height_px * static_cast<double>(map.y_values.size());
  const double width = cell_width_px * static_cast<double>(map.x_values.size());
  std::string content = svg::text(0.0, 14.0, "start", map.title, "font-weight=\"600\"") +
                        svg::text(0.0, 34.0, "start", map.y_title);
  for (std::size_t y = 0; y < map.y_values.size(); ++y) {
    const double from_top = first_row_px + height - cell_height_px * static_cast<double>(y + 1);
    content +=
        svg::text(left_px - 8.0, from_top + 0.5 * cell_height_px + 4.0, "end", map.y_values[y]);
    for (std::size_t x = 0; x < map.x_values.size(); ++x) {
      content += cell_svg(map, map.cells[y * map.x_values.size() + x],
                          left_px + cell_width_px * static_cast<double>(x), from_top);
    }
  }
  for (std::size_t x = 0; x < map.x_values.size(); ++x) {
    content += svg::text(left_px + cell_width_px * (static_cast<double>(x) + 0.5),
                         first_row_px + height + 16.0, "middle", map.x_values[x]);
  }
  content += svg::text(left_px + 0.5 * width, first_row_px + height + 34.0, "middle", map.x_title) +
             legend(map, left_px + width + 12.0, height);
  const double least_px = std::max(svg::width_of(map.title), svg::width_of(map.x_title));
  return svg::picture(std::max(left_px + width + 90.0, least_px), first_row_px + height + 42.0,
                      content);
}

}  // namespace flyball
