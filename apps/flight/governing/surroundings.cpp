// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/governing/surroundings.h"

#include <algorithm>
#include <array>

namespace flyball {
namespace {

constexpr double headroom_limit_m = 5.0;  // Chosen: four times the largest cells.
constexpr double headroom_step_m = 0.05;  // A third of the finest cells.
constexpr double zone_limit_m = 40.0;     // Chosen: twice the range of most shipped cameras.
// Chosen: where density and speed limits ahead are looked up, closer than RoboRun's blocks are
// wide.
constexpr std::array<double, 3> density_places_m{4.0, 8.0, 12.0};
constexpr std::array<double, 5> limit_places_m{4.0, 8.0, 12.0, 16.0, 20.0};

/// On the path, or its end.
Vec3 place_ahead_W(const NavigatorState& navigator, double ahead_m) {
  const Path& path = *navigator.path;
  return path.at(std::min(navigator.s_m + ahead_m, path.length_m())).p_W;
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

double slower_zone_m(const NavigatorState& navigator, const KnobsInForce& knobs, const Site& site) {
  const double here_m_s = knobs.speed_limit_m_s(site, navigator.position_W);
  double nearest_m = zone_limit_m;
  for (const SpeedZone& zone : site.zones) {
    if (zone.max_speed_m_s < here_m_s) {
      nearest_m = std::min(nearest_m, zone.box_W.distance_m(navigator.position_W));
    }
  }
  return nearest_m;
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

// By bisection, because a taller box never holds less.
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

}  // namespace flyball
