// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/second_look.h"

#include <cmath>

namespace flyball {
namespace {

constexpr double spare_m = 0.5;    // Chosen: the vehicle arrives to .3 m.
constexpr double nearest_m = 2.0;  // From nearer, a camera does not see the whole of a person.
constexpr double quarter_rad = 1.5707963267948966;

}  // namespace

std::optional<Viewpoint> second_look(const OccupancyView& map,
                                     const Cylinder& body,
                                     const Aabb& bounds_W,
                                     const Doubt& doubt,
                                     double apart_m) {
  const auto& [place_W, from_W] = doubt;
  const double step_m = apart_m + spare_m;
  const Vec3 out_W = place_W - from_W;
  const double towards_rad = yaw_of(out_W);
  for (const double turn_rad : {0.0, quarter_rad, -quarter_rad, 2.0 * quarter_rad}) {
    const double yaw_rad = towards_rad + turn_rad;
    const Vec3 there_W = from_W + step_m * Vec3{std::cos(yaw_rad), std::sin(yaw_rad), 0.0};
    const bool is_too_near = turn_rad == 0.0 && out_W.head<2>().norm() < nearest_m + step_m;
    if (!is_too_near && bounds_W.contains(there_W) && !map.segment_hits(from_W, there_W, body)) {
      return Viewpoint{there_W, yaw_of(place_W - there_W)};
    }
  }
  return std::nullopt;
}

}  // namespace flyball
