// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The result of one mission.

#include "flyball/flight/mission_end.h"
#include "flyball/governors/policy_abilities.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Obstacles are looked for up to here: a clearance of so much means so much or more.
constexpr double farthest_clearance_m = 5.0;

struct KernelStatistics {
  std::uint64_t calls{};
  double mission_ms_mean{};
  double mission_ms_p95{};
  /// The job that reads a frame first also renders it, so its host time includes that.
  double host_ms_mean{};
};

struct Summary {
  std::string scenario;
  std::string policy;
  std::uint64_t seed{};
  MissionStatus status{MissionStatus::failed};
  MissionFailure failure{MissionFailure::none};
  double mission_time_s{};
  double energy_rotor_j{};
  double energy_computer_j{};
  double battery_start_percent{};
  double battery_end_percent{};
  double distance_m{};
  double mean_speed_m_s{};
  double max_speed_m_s{};  ///< Between take-off and landing, whose speeds no latency bounds.
  double hover_time_s{};   ///< Airborne below .1 m/s.
  int replans{};
  std::uint64_t deadline_misses{};  ///< Of jobs on board, late maps not counted.
  std::uint64_t decisions{};
  std::uint64_t knob_changes{};
  std::uint64_t policy_faults{};  ///< Decisions in which safe settings replaced the policy's.
  std::string policy_trouble{};   ///< Why it failed first, in one sentence; empty: it never did.
  double latency_p50_s{};         ///< Sensor to command.
  double latency_p95_s{};
  double latency_max_s{};
  std::uint64_t maps{};                       ///< Published; each had a latency bound.
  std::uint64_t bound_overruns{};             ///< Maps that violated their bound.
  double budget_use_p50{};                    ///< Latency over its bound.
  std::vector<LevelBounds> latency_bounds{};  ///< Empty for a policy that states no bounds.
  double decision_host_us_p50{};              ///< One decision of the governor, on the host.
  double decision_host_us_p99{};
  std::uint64_t throttle_events{};    ///< How often heat lowered the granted clock.
  std::optional<double> hottest_c{};  ///< Of the computer; empty without a thermal model.
  double min_clearance_m{};           ///< Up to `farthest_clearance_m`.
  std::map<std::string, KernelStatistics> kernels{};
  /// The workload's own quality of flight; the unit is the name's ending.
  std::map<std::string, double> quality{};
  double host_s{};
  double real_time_factor{};
  std::string trace_hash{};
  std::string numeric_fingerprint{};
  std::string version{};

  [[nodiscard]] double energy_total_j() const { return energy_rotor_j + energy_computer_j; }
  [[nodiscard]] double battery_used_percent() const {
    return battery_start_percent - battery_end_percent;
  }
};

[[nodiscard]] inline bool has_succeeded(const Summary& flight) {
  return flight.status == MissionStatus::succeeded;
}

/// Flat, but for `energy_j {rotor, computer, total}`, `latency_s {p50, p95, max}` and `kernels
/// {name: {...}}`, `quality {name: number}` and `latency_bounds`, one object for each level.
[[nodiscard]] std::string to_json(const Summary& summary, int indent = 2);
/// With two digits, `5.00 or more` where no obstacle was nearer.
/// @param unit  Behind the number: " m", or nothing where the unit stands elsewhere.
[[nodiscard]] std::string clearance_text(const Summary& summary, const std::string& unit = "");
/// `was replaced by safe settings in 3 of 400 decisions (after some faults in a row it is not asked
/// again): threw: no more`; empty where it never failed.
[[nodiscard]] std::string trouble_text(std::uint64_t faults,
                                       std::uint64_t decisions,
                                       const std::string& why);
/// @return False, and `summary` is unchanged, when the text is not a summary.
[[nodiscard]] bool from_json(const std::string& text, Summary& summary);

}  // namespace flyball
