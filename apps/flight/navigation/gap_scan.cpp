// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/gap_scan.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double line_spacing_m = 1.0;
// A wall that is thinner than the spacing is still as near as this to one of two lines.
constexpr double near_m = 0.5 * line_spacing_m;
constexpr double least_step_m = 0.25;    // So exact are widths; chosen for the cost of a scan.
constexpr double touching_m = 0.05;      // A third of the finest cells.
constexpr double least_feeling_m = 0.1;  // Less than one of the finest cells.
constexpr double span_step_m = 0.5;  // A wall of .2 m is no farther than .15 m from one of them.
constexpr double look_m = 3.0;       // An obstacle farther away is found from the next step.

/// Asks the map once for the nearest obstacle around. Most often that saves the queries that
/// follow: a place beside this one is at least that distance, less the distance between the two
/// places, away from any obstacle.
class Surroundings {
 public:
  /// @param reach_m  The places that will be asked for are no farther, at the same height.
  Surroundings(const OccupancyView& map, const Vec3& p_W, double reach_m, double half_band_m)
      : map_{map},
        p_W_{p_W},
        half_band_m_{half_band_m},
        nearest_m_{map.nearest_obstacle_m(p_W, reach_m + 2.0 * look_m, half_band_m)} {}
  /// `look_m` at most.
  [[nodiscard]] double nearest_obstacle_m(const Vec3& p_W) const {
    constexpr double rounding_m = 1e-6;
    if (nearest_m_ - (p_W - p_W_).norm() > look_m + rounding_m) {
      return look_m;
    }
    return map_.nearest_obstacle_m(p_W, look_m, half_band_m_);
  }

 private:
  const OccupancyView& map_;
  Vec3 p_W_;
  double half_band_m_;
  double nearest_m_;
};

/// The widest opening on one line. Each step is as long as the nearest obstacle is away.
double widest_m(const Surroundings& map,
                const Vec3& centre_W,
                const Vec3& aside_W,
                const GapScan& scan) {
  double widest = 0.0;
  double closest = 0.0;  // The largest distance where none reaches `near_m`.
  double run_from = 0.0;
  bool is_open = false;
  for (double u = -scan.aside_m; u <= scan.aside_m;) {
    const Vec3 p_W = centre_W + u * aside_W;
    const bool inside = p_W.x() >= scan.bounds_W.min.x() && p_W.x() <= scan.bounds_W.max.x() &&
                        p_W.y() >= scan.bounds_W.min.y() && p_W.y() <= scan.bounds_W.max.y();
    const double clear_m = inside ? map.nearest_obstacle_m(p_W) : 0.0;
    closest = std::max(closest, clear_m);
    if (clear_m >= near_m) {
      run_from = is_open ? run_from : u - clear_m;
      widest = std::max(widest, u + clear_m - run_from);
    }
    is_open = clear_m >= near_m;
    u += std::max(least_step_m, clear_m);
  }
  return widest > 0.0 ? std::min(widest, 2.0 * scan.aside_m) : 2.0 * closest;
}

/// From `p_W` to the first obstacle on this side, `look_m` at most.
double free_aside_m(const OccupancyView& map,
                    const Vec3& p_W,
                    const Vec3& aside_W,
                    double half_band_m) {
  double free_m = 0.0;
  while (free_m < look_m) {
    const double clear_m = map.nearest_obstacle_m(p_W + free_m * aside_W, look_m, half_band_m);
    if (clear_m < touching_m) {
      break;
    }
    free_m += std::max(clear_m, least_feeling_m);
  }
  return std::min(free_m, look_m);
}

}  // namespace

PathWidth narrowest_on(const OccupancyView& map, const PathSpan& span, double half_band_m) {
  const double reach_m = std::min(span.horizon_m, span.path->length_m() - span.from_m);
  PathWidth narrowest{2.0 * look_m, std::max(0.0, reach_m)};
  for (double ahead_m = 0.0; ahead_m <= reach_m; ahead_m += span_step_m) {
    const Path::Sample here = span.path->at(span.from_m + ahead_m);
    const Vec3 left_W = Vec3::UnitZ().cross(here.tangent_W);
    if (left_W.norm() < 0.5) {
      continue;  // Straight up or down.
    }
    const Vec3 aside_W = left_W.normalized();
    const double width_m = free_aside_m(map, here.p_W, aside_W, half_band_m) +
                           free_aside_m(map, here.p_W, -aside_W, half_band_m);
    if (width_m < narrowest.width_m) {
      narrowest = {width_m, ahead_m};
    }
  }
  return narrowest;
}

GapsAhead gaps_ahead(const OccupancyView& map,
                     const Vec3& from_W,
                     const Vec3& towards_W,
                     const GapScan& scan) {
  Vec3 ahead_W = towards_W - from_W;
  ahead_W.z() = 0.0;
  const double distance_m = ahead_W.norm();
  GapsAhead gaps{2.0 * scan.aside_m, scan.reach_m, 2.0 * scan.aside_m};
  if (!(distance_m > 0.0)) {
    return gaps;
  }
  ahead_W /= distance_m;
  const Vec3 aside_W{-ahead_W.y(), ahead_W.x(), 0.0};
  const double reach_m = std::min(scan.reach_m, distance_m);
  const Surroundings around{map, from_W + 0.5 * reach_m * ahead_W,
                            std::hypot(0.5 * reach_m, scan.aside_m), scan.half_band_m};
  double sum_m = 0.0;
  int lines = 0;
  for (double s = 0.0; s <= reach_m; s += line_spacing_m) {
    const double width_m = widest_m(around, from_W + s * ahead_W, aside_W, scan);
    if (width_m < gaps.narrowest_m) {
      gaps.narrowest_m = width_m;
      gaps.narrowest_at_m = s;
    }
    sum_m += width_m;
    ++lines;
  }
  gaps.mean_m = sum_m / lines;
  return gaps;
}

}  // namespace flyball
