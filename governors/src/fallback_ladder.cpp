// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/fallback_ladder.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/observation_fields.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

// Chosen: a clock that is measured wavers by less, and boards whose clocks are 100 MHz apart round
// 2 GHz down by less; two clocks of a TX2 are 3.8 % apart or more.
constexpr double tolerance = 0.02;

bool is_below(double granted, double wanted) {
  return granted < (1.0 - tolerance) * wanted;
}

bool is_near(double granted, double before) {
  return std::abs(granted - before) <= tolerance * before;
}

/// A board that grants more than was requested (its clock may not be set) is no danger: latency is
/// learned at the clock that it has.
bool falls_short(const std::optional<double>& request, double granted, double cap) {
  // Zero: the observation does not tell.
  return request && granted != 0.0 && is_below(granted, std::min(*request, cap));
}

constexpr double no_cap = std::numeric_limits<double>::infinity();

/// Every number finite, no duration negative: what a policy can be asked about.
bool is_believable(const Observation& seen) {
  for (const ObservationField& field : observation_fields()) {
    if (!std::isfinite(field.get(seen))) {
      return false;
    }
  }
  return seen.latency >= Duration::zero() && seen.latency_bound >= Duration::zero() &&
         seen.speed_m_s >= 0.0 && seen.cores >= 0;
}

}  // namespace

std::string_view to_string(Fallback fallback) {
  switch (fallback) {
    case Fallback::none:
      return "none";
    case Fallback::wide_bound:
      return "wide_bound";
    case Fallback::table:
      return "table";
    case Fallback::safe_static:
      return "safe_static";
    case Fallback::hover:
      return "hover";
  }
  return "none";
}

FallbackLadder::FallbackLadder(const FallbackSettings& settings)
    : settings_{settings}, cap_{no_cap, no_cap} {
  FLYBALL_ASSERT(settings_.map_window >= 1 && settings_.map_window <= 64, "map_window=%d",
                 settings_.map_window);
}

Fallback FallbackLadder::look(const Observation& seen, const Request& request) {
  why_ = {};
  if (seen.phase == MissionPhase::unset) {
    why_ = "the observation's phase was never set; set it to what the vehicle does, such as cruise";
    return Fallback::table;
  }
  if (!settings_.enabled) {
    return Fallback::none;
  }
  // Each of them is asked each time: they remember.
  const bool hovers = must_hover(seen);
  const bool mismatched = is_mismatched(seen, request);
  const bool is_valid = is_believable(seen);
  const bool is_late = is_valid && has_coverage_alarm(seen);
  if (hovers) {
    why_ = "deadlines are missed again and again";
    return Fallback::hover;
  }
  if (!is_valid) {
    why_ = "a number that was observed is not finite or negative";
    return Fallback::table;
  }
  if (mismatched) {
    why_ = "clock or cores that were granted are less than what was requested";
    return Fallback::table;
  }
  if (is_late) {
    why_ = "maps came later than bounded";
    return Fallback::wide_bound;
  }
  return Fallback::none;
}

bool FallbackLadder::has_coverage_alarm(const Observation& seen) {
  if (seen.map_revision != revision_) {
    // Against the bound as it was while the map was made: it adapts to each map that comes.
    const bool is_late = bound_ > Duration::zero() && seen.latency > bound_;
    late_ = (late_ << 1U) | (is_late ? 1U : 0U);
    revision_ = seen.map_revision;
  }
  bound_ = seen.latency_bound;
  const std::uint64_t window = ~std::uint64_t{0} >> (64 - settings_.map_window);
  const auto late = static_cast<int>(std::bitset<64>{late_ & window}.count());
  return late >= settings_.late_maps;
}

bool FallbackLadder::is_mismatched(const Observation& seen, const Request& request) {
  const Grant grant{seen.frequency.value(), static_cast<double>(seen.cores)};
  note_cap(grant, seen.now);
  const auto falls_short_of = [&](const Request& asked) {
    return falls_short(asked.frequency_hz, grant.frequency_hz, cap_.frequency_hz) ||
           falls_short(asked.cores, grant.cores, cap_.cores);
  };
  const bool is_short = falls_short_of(request);
  // The patience begins anew where only the newest request is not met yet, and not where a policy
  // goes to and fro between requests that are all not met.
  const bool is_only_newest = !is_table_ && !falls_short_of(last_request_);
  last_request_ = request;
  if (!is_short) {
    mismatched_since_.reset();
  } else if (is_only_newest || !mismatched_since_) {
    mismatched_since_ = seen.now;
  }
  is_table_ = is_short && seen.now - *mismatched_since_ >= settings_.mismatch_patience;
  return is_table_;
}

/// A cap is what the table was given and is believed until more is granted.
void FallbackLadder::note_cap(const Grant& grant, MissionTime now) {
  if (is_below(cap_.frequency_hz, grant.frequency_hz) || is_below(cap_.cores, grant.cores)) {
    cap_ = {no_cap, no_cap};
  }
  const bool is_as_before =
      is_near(grant.frequency_hz, under_table_.frequency_hz) && grant.cores == under_table_.cores;
  if (!is_table_ || !is_as_before) {
    under_table_ = grant;
    under_table_since_ = now;
  } else if (now - under_table_since_ >= settings_.cap_patience) {
    cap_ = grant;
  }
}

bool FallbackLadder::must_hover(const Observation& seen) {
  const double elapsed_s = last_look_ ? std::max(0.0, to_seconds(seen.now - *last_look_)) : 0.0;
  last_look_ = seen.now;
  missed_ = std::max(0.0, missed_ - settings_.miss_drain_hz * elapsed_s);
  // A broken counter shall not hold the vehicle for hours.
  missed_ = std::min(missed_ + seen.deadline_misses, 4.0 * settings_.missed_deadlines);
  if (missed_ > settings_.missed_deadlines && !hovering_since_) {
    hovering_since_ = seen.now;
  }
  if (hovering_since_ && missed_ == 0.0 && seen.now - *hovering_since_ >= settings_.least_hover) {
    hovering_since_.reset();
  }
  return hovering_since_.has_value();
}

}  // namespace flyball
