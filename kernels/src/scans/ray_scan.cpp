// SPDX-License-Identifier: BSD-3-Clause
#include "ray_scan.h"

#include "maps/ray_walk.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double time_units = 1 << 30;  // twice this still fits into an integer

}  // namespace

RayScan::RayScan(double cell_m, Match match, Simd simd)
    : lattice_{cell_m}, match_{match}, loops_{inner_loops(simd)} {
  frame_.cell_m = cell_m;
  frame_.cells_per_m = 1.0 / cell_m;
}

const ScanMasks& RayScan::compute(const Scan& scan) {
  traversals_ = 0;
  ambiguous_ = 0;
  cut_rays(scan);
  span_window();
  for (std::size_t block = 0; block < ends_.size(); ++block) {
    walk_block(block);
  }
  mark_hits(scan.hits_W.size());
  masks_.bricks.clear();
  masks_.updates = static_cast<double>(window_.collect(masks_.bricks));
  masks_.rays = static_cast<double>(rays_);
  masks_.traversals = static_cast<double>(traversals_);
  return masks_;
}

/// Also sets up what the rays have in common.
void RayScan::cut_rays(const Scan& scan) {
  const RayWalk::Cell start = RayWalk::cell_of(lattice_, scan.origin_W);
  frame_.range_m = scan.range_m;
  frame_.units_per_m = time_units / (1.001 * scan.range_m);
  for (unsigned axis = 0; axis < 3; ++axis) {
    frame_.origin_W[axis] = scan.origin_W(axis);
    frame_.start[axis] = start[axis];
    for (const int step : {-1, 1}) {
      // The mixture of double and float is stock's; see RayWalk::aim.
      double border = lattice_.keyToCoord(static_cast<octomap::key_type>(start[axis]));
      border += static_cast<float>(step * frame_.cell_m * 0.5);
      frame_.border_m[axis][step > 0 ? 1 : 0] =
          std::abs(border - static_cast<double>(scan.origin_W(axis)));
    }
  }
  const std::size_t hits = scan.hits_W.size();
  rays_ = hits + scan.clear_W.size();
  ends_.resize((rays_ + lanes - 1) / lanes);
  for (std::size_t block = 0; block < ends_.size(); ++block) {
    std::array<octomap::point3d, lanes> points;
    for (std::size_t lane = 0; lane < rays_in(block); ++lane) {
      const std::size_t ray = block * lanes + lane;
      points[lane] = ray < hits ? scan.hits_W[ray] : scan.clear_W[ray - hits];
    }
    take_points(loops_, points.data(), rays_in(block), ends_[block]);
    loops_.cut_rays(ends_[block], frame_);
  }
}

void RayScan::span_window() {
  std::array<int, 3> low = frame_.start;
  std::array<int, 3> high = frame_.start;
  for (const PointBlock& ends : ends_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int key : ends.key[axis]) {
        low[axis] = std::min(low[axis], key);
        high[axis] = std::max(high[axis], key);
      }
    }
  }
  // A walk in OctoMap's arithmetic may step past its end by a cell.
  window_.span({low[0] - 2, low[1] - 2, low[2] - 2}, {high[0] + 2, high[1] + 2, high[2] + 2});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    axes_.unit[axis] = MarkWindow::unit(axis);
    axes_.bits[axis] = window_.bits(axis);
    axes_.start[axis] = window_.spread(axis, frame_.start[axis]);
  }
}

void RayScan::walk_block(std::size_t block) {
  const PointBlock& ends = ends_[block];
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filled next
  RayBlock rays;
  loops_.aim_rays(ends, frame_, axes_, rays);
  int most_steps = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    most_steps = std::max(most_steps, rays.is_sure[lane] != 0 ? rays.steps[lane] : 0);
  }
  const std::size_t places = static_cast<std::size_t>(most_steps) * lanes;
  if (places_.size() < places) {
    places_.resize(places);
  }
  loops_.walk_rays(rays, axes_, most_steps, places_.data());
  Lanes<std::int32_t> steps{};
  const std::size_t count = rays_in(block);
  for (std::size_t lane = 0; lane < count; ++lane) {
    const bool is_close = match_ == Match::stock && rays.closest[lane] < doubt_units(most_steps);
    if (rays.steps[lane] == 0) {
      continue;  // Stock walks nothing inside one cell.
    }
    if (rays.is_sure[lane] == 0 || is_close) {
      walk_as_stock(ends, lane);
    } else {
      steps[lane] = rays.steps[lane];
      traversals_ += static_cast<std::size_t>(rays.steps[lane]);
    }
  }
  loops_.mark_places(steps, places_.data(), MarkWindow::free_mark, window_.marks());
}

void RayScan::walk_as_stock(const PointBlock& ends, std::size_t lane) {
  ++ambiguous_;
  const octomap::point3d from{frame_.origin_W[0], frame_.origin_W[1], frame_.origin_W[2]};
  const octomap::point3d to{ends.p[0][lane], ends.p[1][lane], ends.p[2][lane]};
  traversals_ += RayWalk{lattice_, from, to}.visit_free([&](const RayWalk::Cell& cell) {
    window_.marks()[window_.place({cell[0], cell[1], cell[2]})] = MarkWindow::free_mark;
  });
}

void RayScan::mark_hits(std::size_t measured_hits) {
  for (std::size_t ray = 0; ray < measured_hits; ++ray) {
    const PointBlock& ends = ends_[ray / lanes];
    const std::size_t lane = ray % lanes;
    if (ends.reaches[lane] != 0) {
      const CellKey cell{ends.key[0][lane], ends.key[1][lane], ends.key[2][lane]};
      window_.marks()[window_.place(cell)] |= MarkWindow::hit_mark;
    }
  }
}

std::size_t RayScan::rays_in(std::size_t block) const {
  return std::min(lanes, rays_ - block * lanes);
}

}  // namespace flyball
