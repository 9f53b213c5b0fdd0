// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/clock_search.h"

#include "flyball/governors/latency_worth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace flyball {
namespace {

constexpr double least_speed_m_s = 0.05;  // Chosen: near zero, energy per metre means nothing.
constexpr double smoothing = 0.1;  // Chosen: the load beside the map is a mean over some seconds.
constexpr double never = std::numeric_limits<double>::infinity();

// At the mission's own speed limit neighbouring clocks differ by milliwatts only. Of those that
// take less than a thousandth more than the best, the highest is taken, which responds soonest.
constexpr double equal = 1e-3;

bool is_positive(double x) {
  return std::isfinite(x) && x > 0.0;
}

/// A latency is predicted from the logarithms of these, so none of them may be 0, nor a clock no
/// clock, whose time for a cycle may be beyond all numbers. Empty: fine.
std::string not_positive(const std::vector<LatencyLevel>& levels,
                         const MapSetting& first,
                         const std::vector<double>& clocks_hz) {
  for (const double hz : {clocks_hz.front(), clocks_hz.back()}) {  // They ascend.
    if (!is_a_clock(hz)) {
      std::array<char, 128> text{};
      std::snprintf(text.data(), text.size(),
                    "knob cpu.frequency_hz may be %g Hz; every clock must be from 1e6 to 1e12 Hz",
                    hz);
      return text.data();
    }
  }
  if (!is_positive(first.range_m)) {
    return "knob map.range_m begins at 0 m; give it a start value above 0";
  }
  if (!std::all_of(levels.begin(), levels.end(),
                   [](const LatencyLevel& one) { return is_positive(one.resolution_m); })) {
    return "knob map.resolution_m may be 0 m; every size of cells must be above 0";
  }
  return "";
}

bool is_finite(const EnergyEstimate& one) {
  return std::isfinite(one.joules_per_m);
}

}  // namespace

double free_ahead_m(const MapSetting& setting, double visibility_m) {
  constexpr double margin_m = 0.5;  // Body and tracking tube. Chosen.
  const double shown_m = std::max(0.0, setting.range_m - setting.resolution_m);
  return std::min(shown_m, visibility_m) - margin_m;
}

double response_s(const ClockSearchSettings& settings, double latency_s) {
  return latency_s + std::max(latency_s, settings.latency.frame_s) + settings.reaction_s;
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
    if (is_finite(one)) {
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

Result<ClockSearch> ClockSearch::make(const ClockSearchSettings& settings,
                                      const std::vector<LatencyLevel>& levels,
                                      const KnobSettings& knobs,
                                      const PowerCost& computer) {
  const KnobSpec* clock = knobs.spec("cpu.frequency_hz");
  if (clock == nullptr || clock->legal.empty()) {
    return Error{ErrorCode::invalid_input,
                 "there is no list of clocks to choose from (knob cpu.frequency_hz)"};
  }
  const MapSetting first{knobs.value("map.resolution_m"), knobs.value("map.range_m"),
                         knobs.value("cpu.frequency_hz")};
  if (const std::string fault = not_positive(levels, first, clock->legal); !fault.empty()) {
    return Error{ErrorCode::invalid_input, fault};
  }
  return ClockSearch{settings, levels, first, clock->legal, computer};
}

ClockSearch::ClockSearch(const ClockSearchSettings& settings,
                         const std::vector<LatencyLevel>& levels,
                         const MapSetting& first,
                         const std::vector<double>& clocks_hz,
                         const PowerCost& computer)
    : settings_{settings},
      clocks_hz_{clocks_hz},
      latency_{settings.latency, levels, first, Hertz{clocks_hz.back()}},
      computer_{computer},
      thermal_{computer},
      idle_{settings.rest_s},
      most_clock_hz_{clocks_hz.back()},
      estimates_(clocks_hz.size()) {}

double ClockSearch::busy_cores(const MapSetting& setting, double latency_s) const {
  const double map_cores =
      std::min(1.0, latency_s / std::max(latency_s, settings_.latency.frame_s));
  return map_cores + other_core_ghz_ / (setting.clock_hz * 1e-9);
}

Watts ClockSearch::computer_power(const MapSetting& setting, double latency_s) const {
  return computer_.power(Hertz{setting.clock_hz}, busy_cores(setting, latency_s));
}

void ClockSearch::learn(const Observation& seen) {
  latency_.learn(seen);
  waits_.note(seen);
  thermal_.learn(seen);
  most_clock_hz_ = thermal_.most_clock_hz(clocks_hz_);
  if (seen.phase == MissionPhase::cruise) {
    rotors_.learn(seen.speed_m_s, seen.rotor_power);
  }
  const double ghz = seen.frequency.value() * 1e-9;
  if (is_positive(ghz) && std::isfinite(seen.busy_cores)) {
    const double others = std::clamp(seen.busy_cores - 1.0, 0.0, 64.0) * std::min(ghz, 10.0);
    other_core_ghz_ += smoothing * (others - other_core_ghz_);
  }
}

EnergyEstimate ClockSearch::estimate(const MapSetting& setting, const Surroundings& around) const {
  const double latency_s = latency_.predicted_s(setting);
  EnergyEstimate one;
  one.setting = setting;
  one.response_s = response_s(settings_, latency_s);
  const double distance_m = free_ahead_m(setting, around.visibility_m);
  const double safe_m_s = safe_speed(around.deceleration_m_s2, one.response_s, distance_m);
  one.speed_m_s = std::max(least_speed_m_s, std::min(safe_m_s, around.speed_limit_m_s));
  const Watts rotor_w = rotors_.power(one.speed_m_s);
  const Watts computer_w = computer_power(setting, latency_s);
  one.joules_per_m = joules_per_metre(rotor_w, computer_w, one.speed_m_s);
  if (safe_m_s < around.speed_limit_m_s) {
    one.watts_per_second =
        watts_per_second(around.deceleration_m_s2, one.response_s, safe_m_s,
                         (rotor_w + computer_w).value(), rotors_.slope_w_s_m(one.speed_m_s));
  }
  return one;
}

void ClockSearch::weigh(const MapSetting& map, const Surroundings& around, double least_clock_hz) {
  for (std::size_t i = 0; i < clocks_hz_.size(); ++i) {
    const double clock_hz = clocks_hz_[i];
    EnergyEstimate& one = estimates_[i];
    one.joules_per_m = never;
    if (clock_hz >= least_clock_hz && clock_hz <= most_clock_hz_) {
      one = estimate({map.resolution_m, map.range_m, clock_hz}, around);
      one.joules_per_m *= waits_.delay(clock_hz, most_clock_hz_);
    }
  }
}

MapSetting ClockSearch::choose(const MapSetting& map, const Observation& seen, bool needs_top) {
  const bool compares = !needs_top && !is_held_up(seen);
  weigh(map, surroundings_of(seen), compares ? 0.0 : most_clock_hz_);
  const auto cheapest = std::min_element(
      estimates_.begin(), estimates_.end(),
      [](const auto& a, const auto& b) { return a.joules_per_m < b.joules_per_m; });
  const auto is_at_most = [&](double share) {
    return [most_j = (1.0 + share) * cheapest->joules_per_m](const EnergyEstimate& one) {
      return one.joules_per_m <= most_j;
    };
  };
  MapSetting best{map.resolution_m, map.range_m, most_clock_hz_};
  if (is_finite(*cheapest)) {  // Clocks of a C caller may be beyond all numbers.
    // The highest clock that is allowed, if no other saves enough, or else the highest of the
    // equals.
    const auto highest = std::find_if(estimates_.rbegin(), estimates_.rend(), is_finite);
    best = is_at_most(settings_.least_saving)(*highest)
               ? highest->setting
               : std::find_if(estimates_.rbegin(), estimates_.rend(), is_at_most(equal))->setting;
  }
  latency_.put_in_force(best, seen.now);
  return best;
}

MapSetting ClockSearch::rest(const MapSetting& map, double within_s, MissionTime now) {
  std::size_t chosen = 0;
  while (chosen + 1 < clocks_hz_.size() &&
         latency_.bounded_s({map.resolution_m, map.range_m, clocks_hz_[chosen]}) > within_s) {
    ++chosen;
  }
  chosen = std::min(chosen + idle_.raised_by(), clocks_hz_.size() - 1);
  for (EnergyEstimate& none : estimates_) {
    none.joules_per_m = never;  // The vehicle makes no progress.
  }
  const MapSetting best{map.resolution_m, map.range_m,
                        std::min(clocks_hz_[chosen], most_clock_hz_)};
  latency_.put_in_force(best, now);
  return best;
}

}  // namespace flyball
