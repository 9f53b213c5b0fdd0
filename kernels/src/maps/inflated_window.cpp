// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/inflated_window.h"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace flyball {
namespace {

constexpr double never = std::numeric_limits<double>::max();

}  // namespace

void InflatedWindow::lay_out(const Layout& layout) {
  layout_ = layout;
  cells_per_m_ = 1.0 / layout.cell_m;
  row_words_ = (layout.cells[0] + 63) / 64;
  words_.assign(static_cast<std::size_t>(row_words_) * static_cast<std::size_t>(layout.cells[1]) *
                    static_cast<std::size_t>(layout.cells[2]),
                0);
}

InflatedWindow::Walk InflatedWindow::walk(const Vec3& from_W, const Vec3& to_W) const {
  Walk at;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<Eigen::Index>(axis);
    const double from = offset(from_W[row], axis);
    const double to = offset(to_W[row], axis);
    at.cell[axis] = static_cast<int>(from);
    at.step[axis] = to < from ? -1 : 1;
    at.left[axis] = std::abs(static_cast<int>(to) - at.cell[axis]);
    at.delta_t[axis] = at.left[axis] == 0 ? 0.0 : 1.0 / std::abs(to - from);
    const double border = to < from ? from - at.cell[axis] : at.cell[axis] + 1.0 - from;
    at.next_t[axis] = at.left[axis] == 0 ? never : border * at.delta_t[axis];
  }
  return at;
}

// From border to border, as Amanatides and Woo (Eurographics 1987). Each axis takes as many steps
// as lie between the two ends' cells, so that rounding cannot carry the walk past its end.
bool InflatedWindow::blocks(const Vec3& from_W, const Vec3& to_W) const {
  if (blocks(from_W) || blocks(to_W)) {
    return true;
  }
  auto [cell, step, left, next_t, delta_t] = walk(from_W, to_W);
  while (left[0] + left[1] + left[2] > 0) {
    const std::size_t xy = next_t[0] <= next_t[1] ? 0 : 1;
    const std::size_t axis = next_t[xy] <= next_t[2] ? xy : 2;
    cell[axis] += step[axis];
    next_t[axis] = --left[axis] == 0 ? never : next_t[axis] + delta_t[axis];
    if (blocks_cell(cell[0], cell[1], cell[2])) {
      return true;
    }
  }
  return false;
}

}  // namespace flyball
