// SPDX-License-Identifier: BSD-3-Clause

#include "studies/plots/cell_picture.h"

#include "studies/plots/svg.h"
#include <algorithm>
#include <array>

namespace flyball {
namespace {

constexpr double map_left_px = 60.0;
constexpr double map_top_px = 30.0;
constexpr double map_width_px = 420.0;

struct Look {
  PlaceState state;
  const char* fill;
  const char* name;
};

// Lightness alone tells them apart as well.
constexpr std::array<Look, 4> looks{{{PlaceState::unknown, "#b9c2cb", "unknown"},
                                     {PlaceState::free, "#f3f5f7", "free"},
                                     {PlaceState::passable, "#8fd3b0", "the body fits"},
                                     {PlaceState::occupied, "#2b3640", "occupied"}}};

const Look& look_of(PlaceState state) {
  return *std::find_if(looks.begin(), looks.end(),
                       [state](const Look& look) { return look.state == state; });
}

std::string filled(const svg::Box& box, const Look& look) {
  return svg::rectangle(box, std::string{"fill=\""} + look.fill + "\"", "");
}

/// Neighbours in a row that look alike are one rectangle. It reaches a little under the row below
/// it, so that no gap shows between them.
std::string row_svg(const CellPicture& picture, std::size_t row, double top_px, double square_px) {
  std::string content;
  const PlaceState* const states = &picture.squares[row * picture.columns];
  for (std::size_t begin = 0; begin < picture.columns;) {
    std::size_t end = begin + 1;
    while (end < picture.columns && states[end] == states[begin]) {
      ++end;
    }
    content += filled({map_left_px + square_px * static_cast<double>(begin), top_px,
                       square_px * static_cast<double>(end - begin), square_px + 0.3},
                      look_of(states[begin]));
    begin = end;
  }
  return content;
}

std::string legend(double top_px) {
  constexpr double step_px = 110.0;
  std::string content;
  double x_px = map_left_px;
  for (const Look& look : looks) {
    content += filled({x_px, top_px, 12.0, 12.0}, look) +
               svg::text(x_px + 18.0, top_px + 10.0, "start", look.name);
    x_px += step_px;
  }
  return content;
}

}  // namespace

const char* to_string(PlaceState state) {
  return look_of(state).name;
}

std::string cell_picture_svg(const CellPicture& picture) {
  const double square_px = map_width_px / static_cast<double>(picture.columns);
  const double height_px = square_px * static_cast<double>(picture.rows());
  const double bottom_px = map_top_px + height_px;
  std::string content = svg::text(0.0, 14.0, "start", picture.title, "font-weight=\"600\"");
  for (std::size_t row = 0; row < picture.rows(); ++row) {
    content +=
        row_svg(picture, row, bottom_px - square_px * static_cast<double>(row + 1), square_px);
  }
  const double width_m = picture.square_m * static_cast<double>(picture.columns);
  const double depth_m = picture.square_m * static_cast<double>(picture.rows());
  content += svg::axes(
      {{picture.least_x_m, picture.least_x_m + width_m, map_left_px, map_left_px + map_width_px},
       {picture.least_y_m, picture.least_y_m + depth_m, bottom_px, map_top_px}});
  content +=
      svg::text(map_left_px + 0.5 * map_width_px, bottom_px + 34.0, "middle", "x, m (y upwards)") +
      legend(bottom_px + 46.0);
  return svg::picture(map_left_px + map_width_px + 20.0, bottom_px + 64.0, content);
}

}  // namespace flyball
