// SPDX-License-Identifier: BSD-3-Clause
#include "visual/overlap.h"

#include <array>

namespace flyball {
namespace {

/// Part of a straight motion, as an interval of its parameter; empty when `first > last`.
struct Span {
  double first{0.0};
  double last{1.0};
};

/// Cuts `span` to where `from + t * step` lies in [low, high].
Span clipped(Span span, double from, double step, double low, double high) {
  constexpr Span none{1.0, 0.0};
  if (step == 0.0) {
    return low <= from && from <= high ? span : none;
  }
  const double t_low = (low - from) / step;
  const double t_high = (high - from) / step;
  return {std::max(span.first, std::min(t_low, t_high)),
          std::min(span.last, std::max(t_low, t_high))};
}

struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d step;
};

double squared_distance(const Segment& segment, const Eigen::Vector2d& p) {
  const double length2 = segment.step.squaredNorm();
  const double t =
      length2 > 0.0 ? std::clamp((p - segment.from).dot(segment.step) / length2, 0.0, 1.0) : 0.0;
  return (segment.from + t * segment.step - p).squaredNorm();
}

/// In the plane. Zero when they cross; else a corner of the one or an end of the other is nearest.
double squared_distance(const Segment& segment, const Aabb& box) {
  Span inside = clipped({}, segment.from.x(), segment.step.x(), box.min.x(), box.max.x());
  inside = clipped(inside, segment.from.y(), segment.step.y(), box.min.y(), box.max.y());
  if (inside.first <= inside.last) {
    return 0.0;
  }
  const Eigen::Vector2d to = segment.from + segment.step;
  double nearest = std::min(squared_distance_xy(box, segment.from.x(), segment.from.y()),
                            squared_distance_xy(box, to.x(), to.y()));
  for (const double x : {box.min.x(), box.max.x()}) {
    for (const double y : {box.min.y(), box.max.y()}) {
      nearest = std::min(nearest, squared_distance(segment, {x, y}));
    }
  }
  return nearest;
}

}  // namespace

SweepShape::SweepShape(const Vec3& from, const Vec3& to, const Cylinder& body)
    : from_{from}, step_{to - from}, body_{solid(body)} {
  const Vec3 half_W{body_.radius_m, body_.radius_m, body_.half_height_m};
  bounds_ = {from.cwiseMin(to) - half_W, from.cwiseMax(to) + half_W};
}

bool SweepShape::overlaps(const Aabb& box) const {
  if (!boxes_overlap(bounds_, box)) {
    return false;
  }
  // Only while the body's height interval meets the box's can its disc hit the box's rectangle.
  const double reach_z_m = body_.half_height_m - touch_m;
  const Span level =
      clipped({}, from_.z(), step_.z(), box.min.z() - reach_z_m, box.max.z() + reach_z_m);
  if (level.first > level.last) {
    return false;
  }
  const Segment segment{(from_ + level.first * step_).head<2>(),
                        (level.last - level.first) * step_.head<2>()};
  const double reach_m = body_.radius_m - touch_m;
  return squared_distance(segment, box) < reach_m * reach_m;
}

}  // namespace flyball
