// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/person.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flyball {
namespace {

constexpr double turning_s = 0.4;  // A walker looks where it will be so soon: no jump at a corner.
constexpr double still_m = 0.02;
constexpr int most_tries = 64;
constexpr double full_turn_rad = 6.283185307179586;

Vec3 place_at(const std::vector<WalkPoint>& walk, double t_s) {
  const auto after =
      std::lower_bound(walk.begin(), walk.end(), t_s,
                       [](const WalkPoint& point, double time_s) { return point.time_s < time_s; });
  if (after == walk.begin()) {
    return walk.front().foot_W;
  }
  if (after == walk.end()) {
    return walk.back().foot_W;
  }
  const WalkPoint& a = *(after - 1);
  const double u = (t_s - a.time_s) / (after->time_s - a.time_s);
  return (1.0 - u) * a.foot_W + u * after->foot_W;
}

double distance_to_leg_m(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Eigen::Vector2d along = (to - from).head<2>();
  const Eigen::Vector2d out = (p - from).head<2>();
  const double u = std::clamp(out.dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (out - u * along).norm();
}

bool is_free(const Vec3& from,
             const Vec3& to,
             const Aabb& area_W,
             const std::vector<WalkObstacle>& obstacles) {
  const bool inside = to.x() >= area_W.min.x() && to.x() <= area_W.max.x() &&
                      to.y() >= area_W.min.y() && to.y() <= area_W.max.y();
  return inside && std::none_of(obstacles.begin(), obstacles.end(), [&](const WalkObstacle& o) {
           return distance_to_leg_m(o.centre_W, from, to) < o.radius_m;
         });
}

/// A leg to where `is_free_to(place)`, after turns that grow when the small ones lead nowhere.
template <class IsFreeTo>
std::optional<Vec3> next_leg(const Vec3& from,
                             double& heading_rad,
                             IsFreeTo&& is_free_to,
                             const WalkStyle& style,
                             RandomStream& random) {
  for (int i = 0; i < most_tries; ++i) {
    const double most_rad =
        std::min(style.largest_turn_rad * (1.0 + 0.25 * i), 0.5 * full_turn_rad);
    const double turn_rad = random.uniform(-most_rad, most_rad);
    const double length_m = style.leg_m * random.uniform(0.5, 1.5);
    const double along_rad = heading_rad + turn_rad;
    const Vec3 to = from + length_m * Vec3{std::cos(along_rad), std::sin(along_rad), 0.0};
    if (is_free_to(to)) {
      heading_rad = along_rad;
      return to;
    }
  }
  return std::nullopt;
}

/// The heading of a person who stands: that of the last leg, if there was one.
double last_heading_rad(const Person& person, double t_s) {
  double heading_rad = person.heading_rad;
  for (std::size_t i = 1; i < person.walk.size() && person.walk[i - 1].time_s < t_s; ++i) {
    const Vec3 leg = person.walk[i].foot_W - person.walk[i - 1].foot_W;
    heading_rad = leg.norm() > still_m ? yaw_of(leg) : heading_rad;
  }
  return heading_rad;
}

}  // namespace

PersonPose Person::at(MissionTime now) const {
  FLYBALL_ASSERT(!walk.empty(), "walk.size()=%zu", walk.size());
  const double t_s = to_seconds(now);
  const Vec3 way = place_at(walk, t_s + turning_s) - place_at(walk, t_s - turning_s);
  const double looks_rad = way.norm() > still_m ? yaw_of(way) : last_heading_rad(*this, t_s);
  return {place_at(walk, t_s), looks_rad};
}

std::vector<WalkPoint> random_walk(const Vec3& start_W,
                                   const Aabb& area_W,
                                   const std::vector<WalkObstacle>& obstacles,
                                   const WalkStyle& style,
                                   RandomStream random) {
  std::vector<WalkPoint> walk{{0.0, start_W}};
  double heading_rad = random.uniform(0.0, full_turn_rad);
  while (walk.back().time_s < style.duration_s) {
    const WalkPoint from = walk.back();
    const bool sprints = random.uniform() < style.sprint_share;
    const double speed_m_s =
        (sprints ? style.sprint_m_s : style.speed_m_s) * random.uniform(0.85, 1.15);
    const auto is_free_to = [&](const Vec3& place) {
      return is_free(from.foot_W, place, area_W, obstacles);
    };
    const auto to = next_leg(from.foot_W, heading_rad, is_free_to, style, random);
    const double length_m = to ? (*to - from.foot_W).norm() : 0.0;
    walk.push_back({from.time_s + (to ? length_m / speed_m_s : 1.0), to.value_or(from.foot_W)});
  }
  return walk;
}

}  // namespace flyball
