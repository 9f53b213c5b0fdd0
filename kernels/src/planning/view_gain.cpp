// SPDX-License-Identifier: BSD-3-Clause
#include "planning/view_gain.h"

#include "planning/side_by_side.h"
#include <algorithm>
#include <cmath>

namespace flyball {

Pyramid::Pyramid(const ViewField& field)
    : tan_across_{std::tan(0.5 * field.horizontal_rad)},
      tan_up_{std::tan(0.5 * field.vertical_rad)},
      cos_{std::cos(field.pitch_down_rad)},
      sin_{std::sin(field.pitch_down_rad)},
      forward_m_{field.forward_m},
      up_m_{field.up_m} {}

Vec3 Pyramid::apex_W(const Viewpoint& view) const {
  return view.p_W +
         Vec3{forward_m_ * std::cos(view.yaw_rad), forward_m_ * std::sin(view.yaw_rad), up_m_};
}

ViewGain::ViewGain(const StateGrid& grid, const Aabb& volume_W, const ViewField& field, int threads)
    : grid_{grid},
      first_{grid.cell_of(volume_W.min)},
      last_{grid.cell_of(volume_W.max - Vec3::Constant(1e-6))},
      range_m_{field.range_m},
      pyramid_{field},
      threads_{threads} {
  for (std::size_t i = 0; i < 3; ++i) {
    first_[i] = std::max(first_[i], grid.first()[i]);
    last_[i] = std::min(last_[i], grid.last()[i]);
  }
}

bool ViewGain::is_in_field(const Viewpoint& view, const GridCell& cell) const {
  const Vec3 to = grid_.centre(cell) - pyramid_.apex_W(view);
  const double forward = std::cos(view.yaw_rad) * to.x() + std::sin(view.yaw_rad) * to.y();
  const double left = std::cos(view.yaw_rad) * to.y() - std::sin(view.yaw_rad) * to.x();
  return pyramid_.holds(forward, left, to.z()) && to.squaredNorm() <= range_m_ * range_m_;
}

double ViewGain::gain_m3(const Viewpoint& view) {
  return gains_m3({view}).front();
}

std::vector<double> ViewGain::gains_m3(const std::vector<Viewpoint>& views) {
  std::vector<Seen> seen(views.size());
  for_each_index(views.size(), threads_, [&](std::size_t i) { seen[i] = seen_from(views[i]); });
  std::vector<double> gains_m3;
  gains_m3.reserve(views.size());
  for (const Seen& one : seen) {
    cells_ += one.looked_at;
    ray_cells_ += one.crossed;
    gains_m3.push_back(one.fresh * grid_.cell_m() * grid_.cell_m() * grid_.cell_m());
  }
  return gains_m3;
}

ViewGain::Seen ViewGain::seen_from(const Viewpoint& view) const {
  const Vec3 reach = Vec3::Constant(range_m_);
  const Vec3 camera_W = pyramid_.apex_W(view);
  GridCell low = grid_.cell_of(camera_W - reach);
  GridCell high = grid_.cell_of(camera_W + reach);
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::max(low[i], first_[i]);
    high[i] = std::min(high[i], last_[i]);
  }
  const Vec3 heading{std::cos(view.yaw_rad), std::sin(view.yaw_rad), 0.0};
  Seen seen;
  for (int y = low[1]; y <= high[1]; ++y) {
    for (int x = low[0]; x <= high[0]; ++x) {
      look_along(camera_W, heading, {x, y, low[2]}, high[2], seen);
    }
  }
  return seen;
}

// The cells of a column share their bearing, so columns outside of the view cost little.
void ViewGain::look_along(
    const Vec3& camera_W, const Vec3& heading, GridCell cell, int top, Seen& seen) const {
  const Vec3 to = grid_.centre(cell) - camera_W;
  const double forward = heading.x() * to.x() + heading.y() * to.y();
  const double left = heading.x() * to.y() - heading.y() * to.x();
  const double spare_m2 = range_m_ * range_m_ - to.head<2>().squaredNorm();
  if (spare_m2 < 0.0 || pyramid_.leaves_out(forward, left)) {
    return;
  }
  const double most_m = std::sqrt(spare_m2);
  for (double z_m = to.z(); cell[2] <= top; ++cell[2], z_m += grid_.cell_m()) {
    if (std::abs(z_m) <= most_m && pyramid_.holds(forward, left, z_m)) {
      seen.looked_at += 1.0;
      const bool is_new = grid_.at(cell) == CellState::unknown;
      seen.fresh += is_new && grid_.sees(camera_W, cell, seen.crossed) ? 1.0 : 0.0;
    }
  }
}

}  // namespace flyball
