// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_loop
#include "flyball/flight/governing/map_signals.h"

#include "flyball/flight/navigation/gap_scan.h"

#include <algorithm>
#include <array>

namespace flyball {
namespace {

// The neighbourhood whose density counts: the delivery camera's range of 7 m less the distance
// flown during one frame, and a band of heights that is just wider than the body. A wider band
// would include cells of the ground, because depth noise at .80 m cells marks all of [0, .80).
constexpr double density_radius_m = 6.0;
constexpr double density_half_band_m = 0.3;
// Chosen: farther obstacles than this make no difference to any policy.
constexpr double nearest_limit_m = 20.0;
constexpr double headroom_limit_m = 5.0;    // Chosen: four times the largest cells.
constexpr double headroom_step_m = 0.05;    // A third of the finest cells.
constexpr double path_width_reach_m = 8.0;  // A little farther than the delivery camera's range.
// Chosen: where density and speed limits ahead are looked up, closer than RoboRun's blocks are
// wide.
constexpr std::array<double, 3> density_places_m{4.0, 8.0, 12.0};
constexpr std::array<double, 5> limit_places_m{4.0, 8.0, 12.0, 16.0, 20.0};

/// On the path, or its end.
Vec3 place_ahead_W(const NavigatorState& navigator, double ahead_m) {
  const Path& path = *navigator.path;
  return path.at(std::min(navigator.s_m + ahead_m, path.length_m())).p_W;
}

double density_ahead(const NavigatorState& navigator, const OccupancyView& map) {
  double most = 0.0;
  if (navigator.has_path()) {
    for (const double ahead_m : density_places_m) {
      const Vec3 p_W = place_ahead_W(navigator, ahead_m);
      most = std::max(most, map.obstacle_density(p_W, density_radius_m, density_half_band_m));
    }
  }
  return most;
}

/// Over the whole body. By bisection, because a taller box never holds less.
double headroom_m(const Vec3& p_W, const Cylinder& body, const OccupancyView& map) {
  const Vec3 half{body.radius_m, body.radius_m, 0.0};
  const Vec3 top_W = p_W + Vec3::UnitZ() * body.half_height_m;
  double free_m = 0.0;
  double blocked_m = headroom_limit_m;
  if (!map.has_occupied({top_W - half, top_W + half + Vec3::UnitZ() * blocked_m})) {
    return headroom_limit_m;
  }
  while (blocked_m - free_m > headroom_step_m) {
    const double middle_m = 0.5 * (free_m + blocked_m);
    const bool is_free = !map.has_occupied({top_W - half, top_W + half + Vec3::UnitZ() * middle_m});
    (is_free ? free_m : blocked_m) = middle_m;
  }
  return blocked_m;
}

void observe_gaps(const NavigatorState& navigator,
                  const OccupancyView& map,
                  const Site& site,
                  Observation& seen) {
  GapScan scan;
  scan.half_band_m = density_half_band_m;
  scan.bounds_W = site.bounds_W;
  const GapsAhead gaps = gaps_ahead(map, navigator.position_W, navigator.goal_W, scan);
  seen.narrowest_gap_m = gaps.narrowest_m;
  seen.gap_distance_m = gaps.narrowest_at_m;
  seen.mean_gap_m = gaps.mean_m;
  if (navigator.has_path()) {
    const PathSpan ahead{navigator.path.get(), navigator.s_m, path_width_reach_m};
    const PathWidth path = narrowest_on(map, ahead, density_half_band_m);
    if (path.width_m < seen.narrowest_gap_m) {
      seen.narrowest_gap_m = path.width_m;
      seen.gap_distance_m = path.at_m;
    }
  }
}

}  // namespace

double speed_limit_ahead(const NavigatorState& navigator,
                         const KnobsInForce& knobs,
                         const Site& site) {
  double least = knobs.speed_limit_m_s(site, navigator.position_W);
  if (navigator.has_path()) {
    for (const double ahead_m : limit_places_m) {
      least = std::min(least, knobs.speed_limit_m_s(site, place_ahead_W(navigator, ahead_m)));
    }
  }
  return least;
}

void observe_no_map(Observation& seen) {
  const GapScan scan;
  seen.nearest_obstacle_m = nearest_limit_m;
  seen.narrowest_gap_m = seen.mean_gap_m = 2.0 * scan.aside_m;
  seen.gap_distance_m = scan.reach_m;
}

void observe_map(const NavigatorState& navigator,
                 const OccupancyView& map,
                 const Brief& brief,
                 Observation& seen) {
  const Vec3& p_W = navigator.position_W;
  seen.obstacle_density = map.obstacle_density(p_W, density_radius_m, density_half_band_m);
  seen.density_ahead = density_ahead(navigator, map);
  observe_gaps(navigator, map, brief.site, seen);
  seen.nearest_obstacle_m = map.nearest_obstacle_m(p_W, nearest_limit_m, density_half_band_m);
  seen.headroom_m = headroom_m(p_W, brief.narrow_body(), map);
}

}  // namespace flyball
