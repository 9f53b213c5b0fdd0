// SPDX-License-Identifier: BSD-3-Clause
#include "clear_spaces.h"

#include <algorithm>

namespace flyball {
namespace {

constexpr double smallest_piece_m = 0.02;

}  // namespace

void ClearSpaces::declare(const Vec3& centre_W, const Cylinder& space) {
  for (const Space& outer : spaces_) {
    if (holds_disc(outer, centre_W, space.radius_m) &&
        holds_heights(outer, centre_W.z() - space.half_height_m,
                      centre_W.z() + space.half_height_m)) {
      return;
    }
  }
  if (spaces_.size() == max_clear) {
    // Where the body has been is declared again and again; take-off and landing places, which are
    // wider, must survive that.
    spaces_.erase(std::min_element(
        spaces_.begin(), spaces_.end(),
        [](const Space& a, const Space& b) { return a.space.radius_m < b.space.radius_m; }));
  }
  spaces_.push_back({centre_W, space});
}

bool ClearSpaces::contains(const Vec3& p_W) const {
  return std::any_of(spaces_.begin(), spaces_.end(), [&](const Space& outer) {
    return holds_disc(outer, p_W, 0.0) && holds_heights(outer, p_W.z(), p_W.z());
  });
}

std::uint64_t ClearSpaces::cells_inside(const Lattice& lattice, const CellKey& brick) const {
  const Aabb around = lattice.cube(brick, brick_level);
  std::uint64_t cells = 0;
  for (const Space& outer : spaces_) {
    if (!BodyShape{outer.centre_W, outer.space}.overlaps(around)) {
      continue;
    }
    for (int bit = 0; bit < 64; ++bit) {
      const Aabb cube = lattice.cube(
          {4 * brick.x + (bit & 3), 4 * brick.y + (bit >> 2 & 3), 4 * brick.z + (bit >> 4)}, 0);
      const bool is_inside =
          holds_heights(outer, cube.min.z(), cube.max.z()) && holds_rectangle(outer, cube);
      cells |= (is_inside ? std::uint64_t{1} : 0) << bit;
    }
  }
  return cells;
}

bool ClearSpaces::cover(const Aabb& part, const BodyShape& body) const {
  if (spaces_.empty()) {
    return false;
  }
  if (!body.overlaps(part) || one_covers(part, body)) {
    return true;
  }
  Eigen::Index axis = 0;
  if ((part.max - part.min).maxCoeff(&axis) <= smallest_piece_m) {
    return false;
  }
  Aabb lower = part;
  Aabb upper = part;
  lower.max[axis] = upper.min[axis] = 0.5 * (part.min[axis] + part.max[axis]);
  return cover(lower, body) && cover(upper, body);
}

bool ClearSpaces::one_covers(const Aabb& part, const BodyShape& body) const {
  return std::any_of(spaces_.begin(), spaces_.end(), [&](const Space& outer) {
    return holds_heights(outer, part.min.z(), part.max.z()) &&
           (holds_disc(outer, body.focus(), body.body().radius_m) || holds_rectangle(outer, part));
  });
}

bool ClearSpaces::holds_disc(const Space& outer, const Vec3& p_W, double radius_m) {
  const double room_m = outer.space.radius_m - radius_m + touch_m;
  return room_m >= 0.0 && (p_W - outer.centre_W).head<2>().squaredNorm() <= room_m * room_m;
}

bool ClearSpaces::holds_heights(const Space& outer, double low_m, double high_m) {
  return low_m >= outer.centre_W.z() - outer.space.half_height_m - touch_m &&
         high_m <= outer.centre_W.z() + outer.space.half_height_m + touch_m;
}

/// The box's farthest corner decides.
bool ClearSpaces::holds_rectangle(const Space& outer, const Aabb& box) {
  const Vec3 far =
      (box.min - outer.centre_W).cwiseAbs().cwiseMax((box.max - outer.centre_W).cwiseAbs());
  const double reach_m = outer.space.radius_m + touch_m;
  return far.head<2>().squaredNorm() <= reach_m * reach_m;
}

}  // namespace flyball
