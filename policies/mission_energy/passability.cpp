// SPDX-License-Identifier: BSD-3-Clause
#include "passability.h"

#include "flyball/governors/waiting_share.h"
#include "flyball/runtime/assert.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

// Chosen by hand.
constexpr double behind_the_gap_m = 3.0;  // A plan through a gap needs to know the space behind it.
constexpr Duration settled = std::chrono::seconds{1};  // Then a map holds several frames.
constexpr double farthest_gap_m = 30.0;  // Longer than the scan for gaps, which reaches 24 m.
constexpr double level_rounding_m = 1e-9;

}  // namespace

double left_of_gap_m(double gap_m, double cells_m, double map_resolution_m) {
  return gap_m - 2.0 * std::max(0.0, cells_m - map_resolution_m);
}

Passability::Passability(const PassabilitySettings& settings, std::vector<double> levels_m)
    : settings_{settings},
      levels_m_{std::move(levels_m)},
      level_{levels_m_.size() - 1},
      retry_level_{level_} {
  FLYBALL_ASSERT(!levels_m_.empty() && std::is_sorted(levels_m_.begin(), levels_m_.end()),
                 "%zu levels", levels_m_.size());
  while (retry_level_ > 0 && levels_m_[retry_level_] > settings_.retry_m + level_rounding_m) {
    --retry_level_;
  }
}

double Passability::least_m(std::size_t level) const {
  return settings_.body_m + 2.0 * levels_m_[level];
}

// A comparison with NaN is false, so an observation without sense gives the finest level.
std::size_t Passability::open_level(const Observation& seen) const {
  for (std::size_t level = levels_m_.size(); level-- > 1 && seen.map_resolution_m > 0.0;) {
    if (left_of_gap_m(seen.narrowest_gap_m, levels_m_[level], seen.map_resolution_m) >=
        least_m(level) - level_rounding_m) {
      return level;
    }
  }
  return 0;
}

// Coarse cells beside an obstacle do not become known free, so the vehicle would have to stop
// there.
std::size_t Passability::clear_level(const Observation& seen, std::size_t open) const {
  std::size_t level = open;
  while (level > 0 &&
         !(seen.nearest_obstacle_m >= 0.5 * settings_.body_m + 2.0 * levels_m_[level])) {
    --level;
  }
  return level;
}

// A plan takes a while, and frames of fine cells with a long range take longest of all. So frames
// with a short range get more time before a long range is asked for.
Passability::Standing Passability::standing(const Observation& seen) {
  const bool stands = stands_in_cruise(seen);
  standing_since_ = stands ? standing_since_.value_or(seen.now) : std::optional<MissionTime>{};
  const Duration stood = stands ? seen.now - *standing_since_ : Duration::zero();
  constexpr int longer = 4;
  if (stood < settings_.patience || stood == Duration::zero()) {
    return Standing::no;
  }
  return stood >= longer * settings_.patience ? Standing::for_good : Standing::stuck;
}

// The finest cells have a short range. So while a gap is still far away, and after a first failed
// plan, the next coarser level is used.
std::size_t Passability::needed_level(const Observation& seen, Standing standing) const {
  if (seen.planner_failures > 1 || standing == Standing::for_good) {
    return 0;
  }
  const bool has_failed = standing != Standing::no || seen.planner_failures > 0;
  const std::size_t coarsest = has_failed ? retry_level_ : levels_m_.size() - 1;
  const std::size_t open = open_level(seen);
  const bool is_far = seen.gap_distance_m > settings_.near_m;
  return std::min(coarsest, is_far ? std::max(open, std::min(std::size_t{1}, retry_level_)) : open);
}

void Passability::count_path(const Observation& seen) {
  const double elapsed_s = last_judged_ ? to_seconds(seen.now - *last_judged_) : 0.0;
  last_judged_ = seen.now;
  const double flown_m = seen.speed_m_s * elapsed_s;
  for (double* on_m : {&gap_on_m_, &failed_on_m_}) {
    if (!(flown_m <= 0.0)) {  // NaN ends the distance; the gap itself still counts.
      *on_m = flown_m < *on_m ? *on_m - flown_m : 0.0;
    }
  }
}

void Passability::need_until_past(const Observation& seen, Standing standing) {
  if (seen.planner_failures > 0 || standing != Standing::no) {
    failed_on_m_ = settings_.near_m;
  } else if (seen.map_resolution_m > 0.0) {  // Before the first map, there is no gap to be past.
    gap_on_m_ =
        std::max(gap_on_m_, std::min(seen.gap_distance_m + behind_the_gap_m, farthest_gap_m));
  }
}

// The gap is near enough to be seen, and a map of the finest cells with more than one frame does
// not show it. So coarse cells had made it up, or the path leads elsewhere by now.
bool Passability::is_gone(const Observation& seen) {
  const bool is_finest = seen.map_resolution_m <= levels_m_.front() + level_rounding_m;
  finest_since_ = is_finest ? finest_since_.value_or(seen.now) : std::optional<MissionTime>{};
  return finest_since_ && seen.now - *finest_since_ >= settled && gap_on_m_ > behind_the_gap_m &&
         gap_on_m_ < settings_.near_m;
}

Passability::Verdict Passability::judge(const Observation& seen) {
  const Standing stands = standing(seen);
  count_path(seen);
  const std::size_t needed = needed_level(seen, stands);
  const bool is_gap_gone = is_gone(seen);
  if (needed == 0) {
    need_until_past(seen, stands);
  } else if (is_gap_gone) {
    gap_on_m_ = 0.0;
  }
  const std::size_t open = std::max(gap_on_m_, failed_on_m_) > 0.0 ? 0 : needed;
  if (needed <= level_) {
    needed_at_ = seen.now;
  }
  if (open <= level_) {
    level_ = open;
  } else if (seen.now - needed_at_ >= settings_.least) {
    level_ = std::max(level_, clear_level(seen, open));
  }
  Verdict verdict;
  verdict.coarsest_level = level_;
  if (stands == Standing::for_good) {
    verdict.look_m = seen.gap_distance_m + behind_the_gap_m;
  }
  return verdict;
}

}  // namespace flyball
