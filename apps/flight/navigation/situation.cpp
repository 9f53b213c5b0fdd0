// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/situation.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// Chosen. A path may be planned just outside of a zone and flown inside it when the map shows more.
constexpr double border_m = 3.0;

}  // namespace

double Situation::least_s(const std::vector<Vec3>& path_W) const {
  constexpr double step_m = 1.0;  // Chosen: shorter than any zone.
  double sum_s = 0.0;
  for (std::size_t i = 1; i < path_W.size(); ++i) {
    const Vec3 along_W = path_W[i] - path_W[i - 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(along_W.norm() / step_m)));
    for (int step = 0; step < steps; ++step) {
      const Vec3 middle_W = path_W[i - 1] + (step + 0.5) / steps * along_W;
      sum_s += along_W.norm() / steps / knobs.speed_limit_m_s(brief.site, middle_W, border_m);
    }
  }
  return sum_s;
}

double Situation::detour_s(const std::vector<Vec3>& path_W) const {
  return path_W.empty() ? 0.0 : least_s(path_W) - least_s({path_W.front(), path_W.back()});
}

std::vector<Aabb> Situation::slow_zones_W() const {
  std::vector<Aabb> slow_W;
  for (const SpeedZone& zone : brief.site.zones) {
    if (zone.max_speed_m_s <= slow_m_s) {
      slow_W.push_back(zone.box_W);
    }
  }
  return slow_W;
}

}  // namespace flyball
