// SPDX-License-Identifier: BSD-3-Clause
#include "ray_scan.h"

#include "../ray_walk.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double time_units = 1 << 30;  // twice this still fits into an integer
constexpr double latest_unit = time_units - 1.0;

/// By how many units the gap of two rounded crossings may be wrong: each began half a unit off, and
/// went half a unit further off with every step.
int doubt_units(int steps) {
  return steps / 2 + 3;
}

}  // namespace

RayScan::RayScan(double cell_m, Match match, Simd simd)
    : lattice_{cell_m}, cell_m_{cell_m}, match_{match}, loops_{inner_loops(simd)} {}

const ScanMasks& RayScan::compute(const Scan& scan) {
  cut_rays(scan);
  span_window();
  prepare_lanes(scan);
  for (const Ray& ray : rays_) {
    add_to_block(ray);
  }
  walk_block();
  for (const Ray& ray : rays_) {
    if (ray.is_hit) {
      window_.mark(window_.place(ray.end), MarkWindow::hit_mark);
    }
  }
  masks_.bricks.clear();
  masks_.updates = static_cast<double>(window_.collect(masks_.bricks));
  masks_.rays = static_cast<double>(rays_.size());
  masks_.traversals = static_cast<double>(traversals_);
  return masks_;
}

// The arithmetic of OccupancyOcTreeBase::computeUpdate, as in scan_update.cpp.
void RayScan::cut_rays(const Scan& scan) {
  origin_W_ = scan.origin_W;
  rays_.clear();
  const auto range_m = static_cast<float>(scan.range_m);
  const auto cut = [&](const octomap::point3d& p_W, bool is_hit) {
    const octomap::point3d ray = p_W - scan.origin_W;
    const bool reaches = ray.norm() <= scan.range_m;
    const octomap::point3d end_W = reaches ? p_W : scan.origin_W + ray.normalized() * range_m;
    const RayWalk::Cell cell = RayWalk::cell_of(lattice_, end_W);
    rays_.push_back({end_W, {cell[0], cell[1], cell[2]}, is_hit && reaches});
  };
  for (const octomap::point3d& p_W : scan.hits_W) {
    cut(p_W, true);
  }
  for (const octomap::point3d& p_W : scan.clear_W) {
    cut(p_W, false);
  }
}

void RayScan::span_window() {
  const RayWalk::Cell start = RayWalk::cell_of(lattice_, origin_W_);
  origin_ = {start[0], start[1], start[2]};
  CellKey low = origin_;
  CellKey high = origin_;
  for (const Ray& ray : rays_) {
    low = {std::min(low.x, ray.end.x), std::min(low.y, ray.end.y), std::min(low.z, ray.end.z)};
    high = {std::max(high.x, ray.end.x), std::max(high.y, ray.end.y), std::max(high.z, ray.end.z)};
  }
  // A walk in OctoMap's arithmetic may step past its end by a cell.
  window_.span({low.x - 2, low.y - 2, low.z - 2}, {high.x + 2, high.y + 2, high.z + 2});
}

void RayScan::prepare_lanes(const Scan& scan) {
  const std::array<int, 3> start{origin_.x, origin_.y, origin_.z};
  for (unsigned axis = 0; axis < 3; ++axis) {
    axes_.bits[axis] = window_.bits(axis);
    axes_.start[axis] = window_.spread(axis, start[axis]);
    for (const int step : {-1, 1}) {
      // The mixture of double and float is stock's; see RayWalk::aim.
      double border = lattice_.keyToCoord(static_cast<octomap::key_type>(start[axis]));
      border += static_cast<float>(step * cell_m_ * 0.5);
      border_m_[axis][step > 0 ? 1 : 0] = border - static_cast<double>(origin_W_(axis));
    }
  }
  units_per_m_ = time_units / (1.001 * scan.range_m);
  lanes_ = 0;
  traversals_ = 0;
  ambiguous_ = 0;
}

void RayScan::add_to_block(const Ray& ray) {
  const int steps = std::abs(ray.end.x - origin_.x) + std::abs(ray.end.y - origin_.y) +
                    std::abs(ray.end.z - origin_.z);
  if (steps == 0) {
    return;  // Stock walks nothing inside one cell.
  }
  steps_[lanes_] = steps;
  if (!aim(ray, lanes_)) {
    walk_as_stock(ray.end_W);
    return;
  }
  ray_of_[lanes_] = &ray;
  if (++lanes_ == RayBlock::lanes) {
    walk_block();
  }
}

/// Sets one lane up. False when rounding might hide the ray's end: it must lie beyond the last
/// border that it crosses along each axis, and before the next, by more than the doubt.
bool RayScan::aim(const Ray& ray, std::size_t lane) {
  octomap::point3d direction = ray.end_W - origin_W_;
  const auto length = static_cast<float>(direction.norm());
  direction /= length;
  const double end_t = static_cast<double>(length) * units_per_m_;
  const double doubt = doubt_units(steps_[lane]);
  const std::array<int, 3> borders{std::abs(ray.end.x - origin_.x), std::abs(ray.end.y - origin_.y),
                                   std::abs(ray.end.z - origin_.z)};
  bool is_sure = true;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto along = static_cast<double>(direction(axis));
    const bool forward = along > 0.0;
    const double units = units_per_m_ / std::max(std::abs(along), 1e-12);
    const double next_t = std::abs(border_m_[axis][forward ? 1 : 0]) * units;
    const double delta_t = cell_m_ * units;
    const double beyond_t = next_t + borders[axis] * delta_t;
    is_sure = is_sure && beyond_t > end_t + doubt &&
              (borders[axis] == 0 || beyond_t - delta_t < end_t - doubt);
    block_.next_t[axis][lane] = static_cast<int>(std::min(next_t, latest_unit) + 0.5);
    block_.delta_t[axis][lane] = static_cast<int>(std::min(delta_t, latest_unit) + 0.5);
    const std::uint32_t unit = MarkWindow::unit(axis);
    block_.step[axis][lane] = forward ? unit : 0U - unit;
    block_.carry[axis][lane] = forward ? ~axes_.bits[axis] : 0U;
  }
  return is_sure;
}

void RayScan::walk_block() {
  if (lanes_ == 0) {
    return;
  }
  const auto last = steps_.begin() + static_cast<std::ptrdiff_t>(lanes_);
  const int most_steps = *std::max_element(steps_.begin(), last);
  const std::size_t rows = static_cast<std::size_t>(most_steps);
  if (places_.size() < rows * RayBlock::lanes) {
    places_.resize(rows * RayBlock::lanes);
  }
  loops_.walk_rays(block_, axes_, most_steps, places_.data());
  for (std::size_t lane = 0; lane < lanes_; ++lane) {
    if (match_ == Match::stock && block_.closest[lane] < doubt_units(most_steps)) {
      walk_as_stock(ray_of_[lane]->end_W);
      continue;
    }
    const auto steps = static_cast<std::size_t>(steps_[lane]);
    for (std::size_t k = 0; k < steps; ++k) {
      window_.mark_free(places_[k * RayBlock::lanes + lane]);
    }
    traversals_ += steps;
  }
  lanes_ = 0;
}

void RayScan::walk_as_stock(const octomap::point3d& end_W) {
  ++ambiguous_;
  traversals_ += RayWalk{lattice_, origin_W_, end_W}.visit_free([&](const RayWalk::Cell& cell) {
    window_.mark_free(window_.place({cell[0], cell[1], cell[2]}));
  });
}

}  // namespace flyball
