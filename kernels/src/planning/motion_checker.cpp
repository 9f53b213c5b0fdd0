// SPDX-License-Identifier: BSD-3-Clause
#include "planning/motion_checker.h"

#include <cmath>

namespace flyball {
namespace {

constexpr double short_piece_m = 0.3;  // Chosen: two fine cells.
// Stock OctoMap at .15 m: 172 ns for a point, 2648 ns for a body (measured, 50 poses indoors).
constexpr double queries_per_cell = 1.0 / 16.0;
// To make a window of 24 x 24 x 6 m takes as long as some 500 motions (measured, see tests/bench).
// So it is made after that many queries, when more are likely to come.
constexpr int many_motions = 500;
constexpr double largest_window_m3 = 10000.0;  // Chosen: it bounds the window's memory.

double volume_m3(const Aabb& box) {
  return (box.max - box.min).cwiseMax(0.0).prod();
}

}  // namespace

MotionChecker::MotionChecker(const OccupancyView& map, const Cylinder& body, double max_slope_rad)
    : map_{map},
      inflatable_{dynamic_cast<const Inflatable*>(&map)},
      body_{body},
      max_rise_{std::tan(max_slope_rad)} {}

void MotionChecker::expect_motions_in(const Aabb& box_W) {
  window_.lay_out({});
  motions_ = 0;
  expected_.reset();
  if (inflatable_ != nullptr && volume_m3(box_W) <= largest_window_m3) {
    expected_ = box_W;
  }
}

bool MotionChecker::is_free(const Vec3& p_WB) {
  queries_ += 1.0;
  return map_.body_state(p_WB, body_) != CellState::occupied;
}

bool MotionChecker::is_flyable(const Vec3& from_W, const Vec3& to_W) {
  const Vec3 piece = to_W - from_W;
  const double rise_m = std::abs(piece.z());
  if (piece.norm() >= short_piece_m && rise_m > max_rise_ * piece.head<2>().norm() + 1e-9) {
    return false;
  }
  queries_ += 1.0;
  return !hits(from_W, to_W);
}

bool MotionChecker::hits(const Vec3& from_W, const Vec3& to_W) {
  if (expected_ && ++motions_ == many_motions) {
    inflatable_->inflate(*expected_, body_, Obstruction::occupied, window_);
  }
  // An empty window blocks everywhere. A bit says only that the body may be in the way somewhere.
  return window_.blocks(from_W, to_W) && map_.segment_hits(from_W, to_W, body_);
}

double MotionChecker::clearance_m(const Vec3& p_WB, double limit_m) {
  queries_ += 1.0;
  return map_.nearest_obstacle_m(p_WB, limit_m, body_.half_height_m);
}

bool MotionChecker::has_occupied(const Aabb& box) {
  queries_ += queries_per_cell;
  return map_.has_occupied(box);
}

}  // namespace flyball
