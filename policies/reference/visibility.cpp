// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double body_m = 0.6;    // Half the width of the body with its tube at speed.
constexpr double forgets = 0.25;  // Chosen: of 4 observations a second, two thirds in one second.
constexpr double tries = 1.15;    // Chosen: the range doubles within five observations.
constexpr double nearest_m = 1.0;
constexpr double farthest_view_m = 1e3;

}  // namespace

void Visibility::note(const Observation& seen, double range_m) {
  if (seen.map_revision != revision_) {
    revision_ = seen.map_revision;
    captured_ = seen.now - std::max(seen.map_age, seen.latency);  // The age may be missing.
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
  // The camera does not see the last cells as a whole. Where the path crosses them at an angle,
  // they reach back by their diagonal.
  const double ends_m = body_m + std::sqrt(2.0) * std::max(0.0, seen.map_resolution_m);
  if (free_m >= seen_to_m - ends_m) {
    visibility_m_ = std::max(free_m, tries * visibility_m_);
  } else {
    visibility_m_ =
        free_m >= visibility_m_ ? free_m : visibility_m_ + forgets * (free_m - visibility_m_);
  }
  visibility_m_ = std::clamp(visibility_m_, nearest_m, farthest_view_m);
}

}  // namespace flyball
