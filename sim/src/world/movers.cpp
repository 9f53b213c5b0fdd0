// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/movers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flyball {
namespace {

/// When a ray passes the two faces of one axis: first, last. One that runs along them is between
/// them always or never.
std::pair<double, double> between_faces(double to_min, double to_max, double direction) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (direction == 0.0) {
    const bool is_between = to_min <= 0.0 && to_max >= 0.0;
    return is_between ? std::pair{-infinity, infinity} : std::pair{infinity, -infinity};
  }
  return std::minmax({to_min / direction, to_max / direction});
}

}  // namespace

Aabb box_at(const Mover& mover, MissionTime now) {
  const Vec3 way = mover.to_W - mover.from_W;
  const double length_m = way.norm();
  Vec3 foot_W = mover.from_W;
  if (length_m > 0.0) {
    const double gone_m = mover.ahead_m + mover.speed_m_s * to_seconds(now);
    const double round_m = std::fmod(gone_m, 2.0 * length_m);  // Exact, whatever the time.
    foot_W += way * (std::min(round_m, 2.0 * length_m - round_m) / length_m);
  }
  const Vec3 half{0.5 * mover.size_m.x(), 0.5 * mover.size_m.y(), 0.0};
  return {foot_W - half, foot_W + half + Vec3::UnitZ() * mover.size_m.z()};
}

double clearance_m(const std::vector<Mover>& movers,
                   MissionTime now,
                   const Vec3& p_WB,
                   const Cylinder& body,
                   double limit_m) {
  double best_m = limit_m;
  for (const Mover& mover : movers) {
    const Aabb box = box_at(mover, now);
    const Vec3 outside = (box.min - p_WB).cwiseMax(p_WB - box.max).cwiseMax(Vec3::Zero());
    const double level_m = std::max(0.0, outside.head<2>().norm() - body.radius_m);
    const double upright_m = std::max(0.0, outside.z() - body.half_height_m);
    best_m = std::min(best_m, std::hypot(level_m, upright_m));
  }
  return best_m;
}

double ray_enters(const Aabb& box, const Vec3& from_W, const Vec3& direction_W) {
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const auto [in, out] = between_faces(box.min[axis] - from_W[axis], box.max[axis] - from_W[axis],
                                         direction_W[axis]);
    enter = std::max(enter, in);
    leave = std::min(leave, out);
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace flyball
