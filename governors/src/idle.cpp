// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/idle.h"

#include <limits>

namespace flyball {
namespace {

// Chosen: every mission begins with a moment of waiting, in which the first map is made.
constexpr double settle_s = 1.0;
// Larger than the space that a scenario declares free around the places of take-off and landing.
constexpr double declared_m = 5.0;

}  // namespace

std::optional<double> Idle::patience_s(const Observation& seen) const {
  if (seen.phase == MissionPhase::wait) {
    return seen.map_within > Duration::zero() ? to_seconds(seen.map_within) : map_s_;
  }
  // A landing after a flight with maps does not count as idle, because the next flight begins with
  // the latencies that are learned now.
  const bool is_blind = seen.map_revision == 0 &&
                        ((seen.phase == MissionPhase::cruise && seen.known_free_m > declared_m) ||
                         seen.phase == MissionPhase::land);
  return is_blind ? std::optional{std::numeric_limits<double>::infinity()} : std::nullopt;
}

std::optional<double> Idle::allowed_s(const Observation& seen) {
  const auto patience = patience_s(seen);
  if (!patience) {
    since_.reset();
    raised_by_ = 0;
    return std::nullopt;
  }
  since_ = since_.value_or(seen.now);
  if (to_seconds(seen.now - *since_) < settle_s) {
    return std::nullopt;
  }
  raised_by_ += seen.deadline_misses > 0 ? 1 : 0;
  return patience;
}

}  // namespace flyball
