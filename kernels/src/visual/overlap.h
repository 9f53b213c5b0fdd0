// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Shapes that are held against the cubes of a map: does the interior of the one meet the interior
/// of the other? Touching is no overlap, so a body may stand against a wall.
///
/// A shape answers `bounds()`, the box around it; `focus()`, where a search had better begin; and
/// `overlaps(box)`, which for boxes in boxes is monotone: no overlap with the outer one, none with
/// the inner.

#include "flyball/runtime/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {

/// Below this depth two shapes touch. Far above the rounding of k * resolution (1e-12 m at 5 km),
/// far below anything that flies.
inline constexpr double touch_m = 1e-9;

[[nodiscard]] inline bool boxes_overlap(const Aabb& a, const Aabb& b) {
  return ((a.max - b.min).array() > touch_m).all() && ((b.max - a.min).array() > touch_m).all();
}

[[nodiscard]] inline Aabb intersection(const Aabb& a, const Aabb& b) {
  return {a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)};
}

/// From `x` to the interval [low, high]; 0 inside.
[[nodiscard]] inline double gap_m(double low, double high, double x) {
  return std::max({low - x, x - high, 0.0});
}

/// Squared distance in the plane from a point to a box's rectangle.
[[nodiscard]] inline double squared_distance_xy(const Aabb& box, double x, double y) {
  const double dx = gap_m(box.min.x(), box.max.x(), x);
  const double dy = gap_m(box.min.y(), box.max.y(), y);
  return dx * dx + dy * dy;
}

/// The cylinder, but never so thin that it would fit between two cubes.
[[nodiscard]] inline Cylinder solid(const Cylinder& body) {
  constexpr double least_m = 1e-6;
  return {std::max(body.radius_m, least_m), std::max(body.half_height_m, least_m)};
}

class BoxShape {
 public:
  explicit BoxShape(const Aabb& box) : box_{box} {}
  [[nodiscard]] const Aabb& bounds() const { return box_; }
  [[nodiscard]] Vec3 focus() const { return 0.5 * (box_.min + box_.max); }
  [[nodiscard]] bool overlaps(const Aabb& box) const { return boxes_overlap(box_, box); }

 private:
  Aabb box_;
};

/// An upright cylinder at rest.
class BodyShape {
 public:
  BodyShape(const Vec3& p_WB, const Cylinder& body)
      : p_WB_{p_WB},
        body_{solid(body)},
        half_W_{body_.radius_m, body_.radius_m, body_.half_height_m},
        bounds_{p_WB - half_W_, p_WB + half_W_},
        squared_reach_m2_{(body_.radius_m - touch_m) * (body_.radius_m - touch_m)} {}

  [[nodiscard]] const Aabb& bounds() const { return bounds_; }
  [[nodiscard]] const Vec3& focus() const { return p_WB_; }
  [[nodiscard]] const Cylinder& body() const { return body_; }
  /// A rectangle overlaps the disc when its squared distance from the centre is less.
  [[nodiscard]] double squared_reach_m2() const { return squared_reach_m2_; }
  [[nodiscard]] bool overlaps(const Aabb& box) const {
    return bounds_.max.z() - box.min.z() > touch_m && box.max.z() - bounds_.min.z() > touch_m &&
           squared_distance_xy(box, p_WB_.x(), p_WB_.y()) < squared_reach_m2_;
  }

 private:
  Vec3 p_WB_;
  Cylinder body_;
  Vec3 half_W_;
  Aabb bounds_;
  double squared_reach_m2_;
};

/// An upright cylinder whose centre moves along a segment.
class SweepShape {
 public:
  SweepShape(const Vec3& from, const Vec3& to, const Cylinder& body);

  [[nodiscard]] const Aabb& bounds() const { return bounds_; }
  [[nodiscard]] const Vec3& focus() const { return from_; }
  [[nodiscard]] bool overlaps(const Aabb& box) const;

 private:
  Vec3 from_;
  Vec3 step_;
  Cylinder body_;
  Aabb bounds_;
};

/// The part of a ball that lies in an altitude band. It shrinks while nearer obstacles are found.
class NearestShape {
 public:
  NearestShape(const Vec3& p_W, double limit_m, double half_band_m)
      : p_W_{p_W}, half_band_m_{half_band_m}, nearest_m_{limit_m}, squared_m2_{above(limit_m)} {}

  [[nodiscard]] Aabb bounds() const {
    const Vec3 half_W{nearest_m_, nearest_m_, std::min(nearest_m_, half_band_m_)};
    return {p_W_ - half_W, p_W_ + half_W};
  }
  [[nodiscard]] const Vec3& focus() const { return p_W_; }
  [[nodiscard]] double nearest_m() const { return nearest_m_; }
  [[nodiscard]] bool overlaps(const Aabb& box) const {
    return squared_distance_m2(box) < squared_m2_;
  }
  void shrink_to(const Aabb& box) {
    nearest_m_ = std::min(nearest_m_, std::sqrt(squared_distance_m2(box)));
    squared_m2_ = above(nearest_m_);
  }

 private:
  /// Not less than the square of any number below it, whatever the rounding.
  static double above(double length_m) { return length_m * length_m * (1.0 + 1e-15); }
  /// To the box's part in the band; beyond every limit when it has none.
  [[nodiscard]] double squared_distance_m2(const Aabb& box) const {
    const double low_m = std::max(box.min.z(), p_W_.z() - half_band_m_);
    const double high_m = std::min(box.max.z(), p_W_.z() + half_band_m_);
    if (high_m - low_m <= touch_m) {
      return std::numeric_limits<double>::infinity();
    }
    const double dz = gap_m(low_m, high_m, p_W_.z());
    return squared_distance_xy(box, p_W_.x(), p_W_.y()) + dz * dz;
  }

  Vec3 p_W_;
  double half_band_m_;
  double nearest_m_;
  double squared_m2_;
};

}  // namespace flyball
