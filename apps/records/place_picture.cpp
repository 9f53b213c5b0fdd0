// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/records/place_picture.h"

#include "flyball/records/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace flyball {
namespace {

constexpr double body_m = 0.3;   // Half a vehicle's width, as worlds check it.
constexpr int wanted_px = 1400;  // Of the longer side, where cells can be that large.
constexpr int most_px = 4000;    // Beyond it several cells share a pixel.
constexpr int largest_cell_px = 12;
constexpr int left_px = 64;  // Room for the numbers.
constexpr int bottom_px = 26;

constexpr Rgb solid{34, 48, 60};
constexpr Rgb roomy{198, 232, 205};
constexpr Rgb narrow{255, 255, 255};
constexpr Rgb unknown{214, 219, 225};
constexpr Rgb line{120, 150, 190};
constexpr Rgb ink{34, 48, 60};

/// Rows of three pixels, from the top; the bits of a row from the left.
struct Glyph {
  char sign;
  std::array<unsigned, 5> rows;
};
constexpr std::array<Glyph, 12> glyphs{{{'0', {7, 5, 5, 5, 7}},
                                        {'1', {2, 6, 2, 2, 7}},
                                        {'2', {7, 1, 7, 4, 7}},
                                        {'3', {7, 1, 7, 1, 7}},
                                        {'4', {5, 5, 7, 1, 1}},
                                        {'5', {7, 4, 7, 1, 7}},
                                        {'6', {7, 4, 7, 5, 7}},
                                        {'7', {7, 1, 2, 2, 2}},
                                        {'8', {7, 5, 7, 5, 7}},
                                        {'9', {7, 5, 7, 1, 7}},
                                        {'-', {0, 0, 7, 0, 0}},
                                        {'.', {0, 0, 0, 0, 2}}}};
constexpr int glyph_px = 2;  // A pixel of a glyph.
constexpr int advance_px = 4 * glyph_px;

/// Where the plan's cells lie in the picture.
struct Layout {
  explicit Layout(const PlacePlan& plan) {
    const int longest = std::max(plan.columns, plan.rows);
    cell_px = std::clamp(wanted_px / longest, 1, largest_cell_px);
    cells = (longest + most_px - 1) / most_px;
    width_px = (plan.columns * cell_px + cells - 1) / cells;
    height_px = (plan.rows * cell_px + cells - 1) / cells;
  }
  [[nodiscard]] int column(int x_px) const { return x_px * cells / cell_px; }
  [[nodiscard]] int row(int y_px) const { return (height_px - 1 - y_px) * cells / cell_px; }
  [[nodiscard]] double px_per_cell() const { return static_cast<double>(cell_px) / cells; }

  int cell_px{};  ///< Pixels of a cell along a side, and cells of a pixel: one of them is 1.
  int cells{};
  int width_px{};
  int height_px{};
};

class Canvas {
 public:
  Canvas(int width_px, int height_px) {
    image_.camera = {width_px, height_px, 0.0, 0.0, 0.0};
    image_.rgb.assign(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                      255);
  }
  void set(int x, int y, const Rgb& colour) {
    const int width = image_.camera.width_px;
    if (x >= 0 && y >= 0 && x < width && y < image_.camera.height_px) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x);
      std::copy(colour.begin(), colour.end(),
                image_.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
  }
  void write(int x, int y, const std::string& text) {
    for (const char sign : text) {
      const auto* glyph = std::find_if(glyphs.begin(), glyphs.end(),
                                       [sign](const Glyph& g) { return g.sign == sign; });
      for (int i = 0; glyph != glyphs.end() && i < 15 * glyph_px * glyph_px; ++i) {
        const int u = i % (3 * glyph_px);
        const int v = i / (3 * glyph_px);
        if ((glyph->rows[static_cast<std::size_t>(v / glyph_px)] >> (2 - u / glyph_px) & 1U) != 0) {
          set(x + u, y + v, ink);
        }
      }
      x += advance_px;
    }
  }
  [[nodiscard]] ColourImage take() { return std::move(image_); }

 private:
  ColourImage image_{};
};

/// Metres between two lines: at least so many pixels apart.
double metres_between(double px_per_m) {
  constexpr double least_px = 50.0;
  double metres = 1.0;
  for (int i = 0; metres * px_per_m < least_px; ++i) {
    metres *= i % 3 == 1 ? 2.5 : 2.0;  // 1, 2, 5, 10, ...
  }
  return metres;
}

bool is_solid(const PlacePlan& plan, int column, int row) {
  return column >= 0 && row >= 0 && column < plan.columns && row < plan.rows &&
         plan.at(column, row) == CellState::occupied;
}

/// Of the cells that share a pixel: a solid one is never lost.
Rgb colour_of(
    const PlacePlan& plan, const std::vector<bool>& room, const Layout& at, int x, int y) {
  const int column = at.column(x);
  const int row = at.row(y);
  for (int i = 0; i < at.cells * at.cells; ++i) {
    if (is_solid(plan, column + i % at.cells, row + i / at.cells)) {
      return solid;
    }
  }
  if (plan.at(column, row) == CellState::unknown) {
    return unknown;
  }
  const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(plan.columns) +
                    static_cast<std::size_t>(column);
  return room[cell] ? roomy : narrow;
}

void draw_lines(const PlacePlan& plan, const Layout& at, Canvas& canvas) {
  const double px_per_m = at.px_per_cell() / plan.cell_m;
  const double step_m = metres_between(px_per_m);
  const Vec3& low = plan.extent_W.min;
  for (double x_m = std::ceil(low.x() / step_m) * step_m; x_m <= plan.extent_W.max.x();
       x_m += step_m) {
    const int x = left_px + static_cast<int>((x_m - low.x()) * px_per_m);
    for (int y = 0; y < at.height_px + 4; y += y < at.height_px ? 4 : 1) {
      canvas.set(x, y, line);
    }
    canvas.write(x - advance_px, at.height_px + 8, std::to_string(std::lround(x_m)));
  }
  for (double y_m = std::ceil(low.y() / step_m) * step_m; y_m <= plan.extent_W.max.y();
       y_m += step_m) {
    const int y = at.height_px - 1 - static_cast<int>((y_m - low.y()) * px_per_m);
    for (int x = left_px - 4; x < left_px + at.width_px; x += x < left_px ? 1 : 4) {
      canvas.set(x, y, line);
    }
    canvas.write(4, y - 5, std::to_string(std::lround(y_m)));
  }
}

}  // namespace

std::vector<bool> cells_with_room(const PlacePlan& plan) {
  std::vector<bool> room(plan.cells.size());
  for (std::size_t i = 0; i < room.size(); ++i) {
    room[i] = plan.cells[i] == CellState::free;
  }
  const int reach = static_cast<int>(std::ceil(body_m / plan.cell_m + 0.5));
  const auto apart_m = [&](int cells) {
    return std::max(0.0, std::abs(cells) - 0.5) * plan.cell_m;
  };
  const auto take_room = [&](int column, int row, int dx, int dy) {
    const bool is_inside =
        column + dx >= 0 && column + dx < plan.columns && row + dy >= 0 && row + dy < plan.rows;
    if (is_inside && std::hypot(apart_m(dx), apart_m(dy)) <= body_m) {
      room[static_cast<std::size_t>(row + dy) * static_cast<std::size_t>(plan.columns) +
           static_cast<std::size_t>(column + dx)] = false;
    }
  };
  for (int cell = 0; cell < plan.columns * plan.rows; ++cell) {
    const int column = cell % plan.columns;
    const int row = cell / plan.columns;
    const bool is_inner = is_solid(plan, column - 1, row) && is_solid(plan, column + 1, row) &&
                          is_solid(plan, column, row - 1) && is_solid(plan, column, row + 1);
    if (!is_solid(plan, column, row) || is_inner) {
      continue;
    }
    for (int i = 0; i < (2 * reach + 1) * (2 * reach + 1); ++i) {
      take_room(column, row, i % (2 * reach + 1) - reach, i / (2 * reach + 1) - reach);
    }
  }
  return room;
}

ColourImage picture_of(const PlacePlan& plan) {
  const std::vector<bool> room = cells_with_room(plan);
  const Layout at{plan};
  Canvas canvas{left_px + at.width_px, at.height_px + bottom_px};
  for (int y = 0; y < at.height_px; ++y) {
    for (int x = 0; x < at.width_px; ++x) {
      canvas.set(left_px + x, y, colour_of(plan, room, at, x, y));
    }
  }
  draw_lines(plan, at, canvas);
  return canvas.take();
}

}  // namespace flyball
