// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flyball/studies/sweep.h"

#include "made_flights.h"
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// Policy `fixed` over `a` = 1, 2 with seeds 1 and 2: mission times of 100 a + seed.
inline Sweep made_sweep() {
  const SweepPlan plan{"made", {{"a", {"1", "2"}}}, {"fixed"}, {1, 2}};
  std::vector<SweepFlight> flights;
  for (std::size_t point = 0; point < 2; ++point) {
    for (const std::uint64_t seed : plan.seeds) {
      Summary summary = made_summary("fixed", seed);
      summary.mission_time_s = 100.0 * static_cast<double>(point + 1) + static_cast<double>(seed);
      flights.push_back({point, "flyball run made", std::move(summary)});
    }
  }
  return sweep_of(plan, {"flyball compare made", "flyball compare made too"}, std::move(flights));
}

}  // namespace flyball
