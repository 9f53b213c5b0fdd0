// SPDX-License-Identifier: BSD-3-Clause
#include "planning/path_simplifier.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flyball {
namespace {

using Polygon = std::vector<Vec3>;
using Step = Polygon::difference_type;

constexpr int shortcuts = 40;  // Tries; more shortened the test scene's paths by < 1 %.
// Chosen by hand.
constexpr double worthwhile_m = 0.01;       // A waypoint moves if it gains this much clearance.
constexpr double too_close_m = 0.2;         // A waypoint this near to another one is left out.
constexpr double enough_clearance_m = 1.0;  // So far from obstacles a waypoint stays.
constexpr int centring_rounds = 2;

/// From each point straight to the farthest one that can be reached.
void drop_vertices(Polygon& points, MotionChecker& checker) {
  Polygon kept{points.front()};
  std::size_t here = 0;
  while (here + 1 < points.size()) {
    std::size_t next = points.size() - 1;
    while (next > here + 1 && !checker.is_flyable(points[here], points[next])) {
      --next;
    }
    kept.push_back(points[next]);
    here = next;
  }
  points = std::move(kept);
}

struct Place {
  std::size_t piece{};
  Vec3 p_W{Vec3::Zero()};
  double s_m{};
};

Place place_at(const Polygon& points, double s_m) {
  double left_m = s_m;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 piece = points[i + 1] - points[i];
    const double piece_m = piece.norm();
    if (left_m < piece_m || i + 2 == points.size()) {
      const double share = piece_m > 0.0 ? std::min(1.0, left_m / piece_m) : 0.0;
      return {i, points[i] + share * piece, s_m};
    }
    left_m -= piece_m;
  }
  return {};
}

using Span = std::pair<Place, Place>;

Span anywhere(const Polygon& points, RandomStream& random) {
  const double total_m = length_m(points);
  const double one_m = random.uniform(0.0, total_m);
  const double other_m = random.uniform(0.0, total_m);
  return {place_at(points, std::min(one_m, other_m)), place_at(points, std::max(one_m, other_m))};
}

/// Around one corner, no farther from it than twice its shorter piece: a detour of metres before
/// hundreds of metres straight ahead would hardly ever be hit by places drawn anywhere.
Span across_a_corner(const Polygon& points, RandomStream& random) {
  const auto inner = static_cast<double>(points.size() - 2);
  const auto i =
      1 + std::min(points.size() - 3, static_cast<std::size_t>(random.uniform(0.0, inner)));
  const Vec3 back = points[i - 1] - points[i];
  const Vec3 on = points[i + 1] - points[i];
  const double reach_m = 2.0 * std::min(back.norm(), on.norm());
  const double back_m = random.uniform(0.0, std::min(back.norm(), reach_m));
  const double on_m = random.uniform(0.0, std::min(on.norm(), reach_m));
  return {{i - 1, points[i] + back_m * back.normalized(), -back_m},
          {i, points[i] + on_m * on.normalized(), on_m}};
}

void shortcut(Polygon& points, MotionChecker& checker, RandomStream& random) {
  for (int i = 0; i < shortcuts && points.size() > 2; ++i) {
    const auto [from, to] = i % 2 == 0 ? across_a_corner(points, random) : anywhere(points, random);
    const double saved_m = to.s_m - from.s_m - (to.p_W - from.p_W).norm();
    if (from.piece == to.piece || saved_m < worthwhile_m || !checker.is_flyable(from.p_W, to.p_W) ||
        !checker.is_flyable(points[from.piece], from.p_W) ||
        !checker.is_flyable(to.p_W, points[to.piece + 1])) {
      continue;
    }
    const auto first = points.begin() + static_cast<Step>(from.piece) + 1;
    const auto last = points.begin() + static_cast<Step>(to.piece) + 1;
    points.insert(points.erase(first, last), {from.p_W, to.p_W});
  }
}

/// Where to move a corner, the best place first: away from its inside, where its obstacle stands.
std::vector<Vec3> places_near(const Polygon& points, std::size_t i) {
  const Vec3 inside = 0.5 * (points[i - 1] + points[i + 1]) - points[i];
  const double away_rad = inside.head<2>().norm() > 1e-6 ? yaw_of(-inside) : 0.0;
  constexpr double quarter_rad = 1.5707963267948966;
  std::vector<Vec3> places;
  for (const double step_m : {0.6, 0.3, 0.1}) {
    for (const double turn_rad : {0.0, quarter_rad, -quarter_rad}) {
      const double yaw_rad = away_rad + turn_rad;
      places.push_back(points[i] + step_m * Vec3{std::cos(yaw_rad), std::sin(yaw_rad), 0.0});
    }
  }
  return places;
}

/// Moves one corner to the first place that is farther from obstacles.
bool centre(Polygon& points, std::size_t i, MotionChecker& checker, const Aabb& bounds_W) {
  const double now_m = checker.clearance_m(points[i], enough_clearance_m);
  if (now_m >= enough_clearance_m) {
    return false;
  }
  for (const Vec3& place : places_near(points, i)) {
    if (bounds_W.contains(place) &&
        checker.clearance_m(place, enough_clearance_m) > now_m + worthwhile_m &&
        checker.is_flyable(points[i - 1], place) && checker.is_flyable(place, points[i + 1])) {
      points[i] = place;
      return true;
    }
  }
  return false;
}

/// Room beside the path lets the vehicle be faster. Where it is slow in any case, a path that
/// leaves every wall would only be longer: in rooms by a third, and a zigzag.
void centre_all(Polygon& points, MotionChecker& checker, const PlanRequest& request) {
  const auto is_slow_at = [&](const Vec3& p_W) {
    return std::any_of(request.slow_W.begin(), request.slow_W.end(),
                       [&](const Aabb& zone_W) { return zone_W.contains(p_W); });
  };
  for (int round = 0; round < centring_rounds; ++round) {
    bool moved = false;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      moved = (!is_slow_at(points[i]) && centre(points, i, checker, request.bounds_W)) || moved;
    }
    if (!moved) {
      return;
    }
  }
}

void merge_close(Polygon& points, MotionChecker& checker) {
  for (std::size_t i = 1; i + 1 < points.size();) {
    const bool close = (points[i] - points[i - 1]).norm() < too_close_m ||
                       (points[i + 1] - points[i]).norm() < too_close_m;
    if (close && checker.is_flyable(points[i - 1], points[i + 1])) {
      points.erase(points.begin() + static_cast<Step>(i));
    } else {
      ++i;
    }
  }
}

}  // namespace

std::vector<Vec3> simplify(std::vector<Vec3> points_W,
                           MotionChecker& checker,
                           const PlanRequest& request) {
  FLYBALL_ASSERT(points_W.size() >= 2, "points=%zu", points_W.size());
  RandomStream random{request.seed, "path_simplifier"};
  drop_vertices(points_W, checker);
  shortcut(points_W, checker, random);
  drop_vertices(points_W, checker);
  centre_all(points_W, checker, request);
  merge_close(points_W, checker);
  return points_W;
}

}  // namespace flyball
