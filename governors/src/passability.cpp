// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/passability.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

constexpr double standing_m_s = 0.1;
constexpr double behind_the_gap_m = 3.0;  // What a plan through it needs to know.
constexpr double rounding_m = 1e-9;

}  // namespace

Passability::Passability(const PassabilitySettings& settings, std::vector<double> levels_m)
    : settings_{settings}, levels_m_{std::move(levels_m)}, level_{levels_m_.size() - 1} {
  FLYBALL_ASSERT(!levels_m_.empty() && std::is_sorted(levels_m_.begin(), levels_m_.end()),
                 "%zu levels", levels_m_.size());
}

// Comparisons with what is not a number are false, so it leaves the finest level.
std::size_t Passability::open_level(const Observation& seen) const {
  for (std::size_t level = levels_m_.size(); level-- > 1;) {
    const double coarser_m = levels_m_[level] - seen.map_resolution_m;
    if (coarser_m >= -rounding_m &&
        seen.narrowest_gap_m - 2.0 * coarser_m >= settings_.body_m - rounding_m) {
      return level;
    }
  }
  return 0;
}

// Coarse cells beside an obstacle are not known free: among them the vehicle would have to stop.
bool Passability::is_clear_of_obstacles(const Observation& seen, std::size_t level) const {
  return seen.nearest_obstacle_m >= 0.5 * settings_.body_m + 2.0 * levels_m_[level];
}

Duration Passability::standing(const Observation& seen) {
  const bool stands = seen.phase == MissionPhase::cruise && !(seen.speed_m_s > standing_m_s);
  standing_since_ = stands ? standing_since_.value_or(seen.now) : std::optional<MissionTime>{};
  return stands ? seen.now - *standing_since_ : Duration::zero();
}

Passability::Verdict Passability::judge(const Observation& seen) {
  const Duration stood = standing(seen);
  const bool is_stuck = stood >= settings_.patience && stood > Duration::zero();
  const std::size_t open = seen.planner_failures > 0 || is_stuck ? 0 : open_level(seen);
  if (open <= level_) {
    level_ = open;
    needed_at_ = seen.now;
  } else if (seen.now - needed_at_ >= settings_.least && is_clear_of_obstacles(seen, open)) {
    level_ = open;
  }
  Verdict verdict;
  verdict.coarsest_level = level_;
  if (is_stuck && stood >= 2 * settings_.patience) {
    verdict.look_m = seen.gap_distance_m + behind_the_gap_m;
  }
  return verdict;
}

}  // namespace flyball
