// SPDX-License-Identifier: BSD-3-Clause
#include "sight.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double body_m = 0.6;    // With its tube at speed, half.
constexpr double forgets = 0.25;  // Of looks 4 times a second: two thirds of the way in a second.
constexpr double tries = 1.15;
constexpr double nearest_m = 1.0;
constexpr double farthest_m = 1e3;

}  // namespace

void Sight::note(const Observation& seen, double range_m) {
  if (seen.map_revision != revision_) {
    revision_ = seen.map_revision;
    captured_ = seen.now - std::max(seen.map_age, seen.latency);  // Not all tell the age.
  }
  if (std::isfinite(range_m) && range_m != range_m_) {
    last_range_m_ = range_m_ > 0.0 ? range_m_ : range_m;
    range_m_ = range_m;
    changed_ = seen.now;
  }
  const double seen_to_m = captured_ < changed_ ? last_range_m_ : range_m_;
  const double free_m = seen.known_free_m + seen.speed_m_s * to_seconds(seen.now - captured_);
  if (seen.phase != MissionPhase::cruise || !std::isfinite(free_m)) {
    return;
  }
  // The last cells are not seen as a whole, and where the way crosses them at an angle they reach
  // as far back as their diagonal.
  const double ends_m = body_m + std::sqrt(2.0) * std::max(0.0, seen.map_resolution_m);
  if (free_m >= seen_to_m - ends_m) {
    sight_m_ = std::max(free_m, tries * sight_m_);
  } else {
    sight_m_ = free_m >= sight_m_ ? free_m : sight_m_ + forgets * (free_m - sight_m_);
  }
  sight_m_ = std::clamp(sight_m_, nearest_m, farthest_m);
}

}  // namespace flyball
