// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/search_space.h"

#include "flyball/governors/waiting_share.h"
#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {

std::vector<SearchLevel> levels_between(const std::vector<double>& resolutions_m,
                                        double fine_s,
                                        double coarse_s) {
  FLYBALL_ASSERT(!resolutions_m.empty() && fine_s > 0.0 && coarse_s > 0.0, "%zu levels, %g s, %g s",
                 resolutions_m.size(), fine_s, coarse_s);
  constexpr double fine_slope = 2.2;  // Volume dominates in small cells, rays in large ones.
  constexpr double coarse_slope = 1.0;
  const double span = std::log(resolutions_m.back() / resolutions_m.front());
  std::vector<SearchLevel> levels;
  for (const double r_m : resolutions_m) {
    const double u = span > 0.0 ? std::log(r_m / resolutions_m.front()) / span : 0.0;
    SearchLevel level;
    level.resolution_m = r_m;
    level.latency_s = fine_s * std::pow(coarse_s / fine_s, u);
    level.range_slope = fine_slope + (coarse_slope - fine_slope) * u;
    levels.push_back(level);
  }
  return levels;
}

double smallest_cells_m(const KnobSpec& resolution, double given_m) {
  constexpr double usual_m = 0.15;  // MAVBench's fine cells.
  if (given_m > 0.0) {
    return resolution.nearest(given_m);
  }
  return resolution.legal.empty() ? usual_m : resolution.legal.front();
}

std::vector<double> ranges_between(double least_m, double most_m) {
  FLYBALL_ASSERT(least_m > 0.0 && least_m < most_m, "%g m to %g m", least_m, most_m);
  constexpr int steps = 4;
  std::vector<double> ranges_m;
  ranges_m.reserve(steps + 1);
  for (int i = 0; i < steps; ++i) {
    ranges_m.push_back(least_m * std::pow(most_m / least_m, i / double{steps}));
  }
  ranges_m.push_back(most_m);
  return ranges_m;
}

double free_ahead_m(const EnergySearchSettings& price,
                    const MapSetting& setting,
                    double visibility_m) {
  const double shown_m = std::max(0.0, setting.range_m - setting.resolution_m);
  return std::min(shown_m, visibility_m) - price.margin_m;
}

double path_over_line(const EnergySearchSettings& price, double resolution_m, double shows_m) {
  if (price.spacing_m <= 0.0) {
    return 1.0;
  }
  const double w_m = price.half_width_m;
  const double s_m = std::max(shows_m, 0.0);
  return 1.0 + (resolution_m + std::hypot(s_m, w_m) - s_m) / price.spacing_m;
}

Surroundings limits_of(const Observation& seen) {
  // The defaults of a mission (MissionSettings).
  constexpr double usual_m_s = 10.0;
  constexpr double usual_m_s2 = 6.0;
  const double limit_m_s = seen.speed_limit_m_s;
  const double brakes_m_s2 = seen.max_deceleration_m_s2;
  Surroundings around;
  around.speed_limit_m_s =
      std::isfinite(limit_m_s) && limit_m_s > 0.0 ? std::min(limit_m_s, 100.0) : usual_m_s;
  around.deceleration_m_s2 = brakes_m_s2 > 0.1 && brakes_m_s2 < 100.0 ? brakes_m_s2 : usual_m_s2;
  around.visibility_m = std::numeric_limits<double>::max();
  return around;
}

bool is_held_up(const Observation& seen) {
  constexpr double nearly = 0.9;  // The reference approaches its limit gradually.
  if (seen.phase != MissionPhase::cruise || stands_in_cruise(seen)) {
    return true;
  }
  const bool is_free = seen.planner_failures == 0 && seen.narrowest_gap_m >= open_path_m;
  return !is_free && seen.speed_m_s < nearly * limits_of(seen).speed_limit_m_s;
}

double shown_free_m(const Observation& seen) {
  constexpr double farthest_m = 1e6;
  const double flown_m = seen.speed_m_s * std::max(0.0, to_seconds(seen.latency));
  const double shown_m = seen.known_free_m + std::max(0.0, flown_m);
  return std::isfinite(shown_m) ? std::clamp(shown_m, 0.0, farthest_m) : 0.0;
}

Decision decision_for(const MapSetting& setting) {
  Decision wish;
  wish.reason = Reason::energy;
  wish.set("map.resolution_m", setting.resolution_m);
  wish.set("map.range_m", setting.range_m);
  wish.set("cpu.frequency_hz", setting.clock_hz);
  return wish;
}

std::vector<PolicyOption> options_of(const std::vector<EnergyEstimate>& weighed) {
  std::vector<PolicyOption> all;
  for (const EnergyEstimate& one : weighed) {
    if (std::isfinite(one.joules_per_m)) {
      PolicyOption option;
      option.setting = decision_for(one.setting);
      option.speed_m_s = one.speed_m_s;
      option.joules_per_m = one.joules_per_m;
      option.response_s = one.response_s;
      option.watts_per_second = one.watts_per_second;
      all.push_back(option);
    }
  }
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.joules_per_m < b.joules_per_m; });
  return all;
}

}  // namespace flyball
