// SPDX-License-Identifier: BSD-3-Clause
#include "clear_spaces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace flyball {
namespace {

// Pieces end at whole multiples of this: an eighth of the usual finest cell, on whose borders the
// parts of such a map end, too. So the answer does not depend on how a map cuts unknown space.
constexpr double smallest_piece_m = 0.15 / 8.0;

/// Of the planes in a part, across an axis, the one on the coarsest power of two of pieces.
std::optional<double> plane_in(double low_m, double high_m) {
  constexpr double touch = touch_m / smallest_piece_m;
  constexpr double farthest_m = 1e6;  // no lattice reaches there, and planes are rounded away
  if (!(low_m > -farthest_m && high_m < farthest_m)) {
    return std::nullopt;
  }
  const auto before = static_cast<std::int64_t>(std::floor(low_m / smallest_piece_m + touch));
  const auto last = static_cast<std::int64_t>(std::ceil(high_m / smallest_piece_m - touch)) - 1;
  if (last <= before) {
    return std::nullopt;
  }
  std::int64_t plane = last;
  while (plane != 0 && (plane & (plane - 1)) > before) {
    plane &= plane - 1;  // without its lowest bit
  }
  return static_cast<double>(plane) * smallest_piece_m;
}

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
  std::optional<double> plane;
  for (const Eigen::Index other : {0, 1, 2}) {
    const bool is_longest =
        !plane || part.max[other] - part.min[other] > part.max[axis] - part.min[axis];
    const auto in_other = is_longest ? plane_in(part.min[other], part.max[other]) : std::nullopt;
    if (in_other) {
      axis = other;
      plane = in_other;
    }
  }
  if (!plane) {
    return false;
  }
  Aabb lower = part;
  Aabb upper = part;
  lower.max[axis] = upper.min[axis] = *plane;
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
