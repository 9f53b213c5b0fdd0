// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission
#include "simulation/mission_summary.h"

#include "flyball/runtime/quantile.h"

namespace flyball {
namespace {

void fill_outcome(Summary& summary, const SimulatedFlight& flight, const Scenario& scenario) {
  const FlightLog& log = flight.loop->log();
  summary.scenario = scenario.name;
  summary.policy = scenario.governor.policy;
  summary.seed = scenario.seed;
  const FlightVerdict verdict = flight.referee->verdict();
  summary.status = verdict.status;
  summary.failure = verdict.failure;
  summary.mission_time_s = to_seconds(flight.queue.now());
  summary.energy_rotor_j = log.energy_rotor_j;
  summary.energy_computer_j = log.energy_computer_j;
  summary.battery_start_percent = 100.0 * scenario.vehicle.battery_charge;
  summary.battery_end_percent = flight.loop->battery().percent();
  summary.distance_m = log.distance_m;
  summary.mean_speed_m_s = log.airborne_s > 0.0 ? log.distance_m / log.airborne_s : 0.0;
  summary.max_speed_m_s = log.max_speed_m_s;
  summary.hover_time_s = log.hover_time_s;
  summary.min_clearance_m = flight.referee->min_clearance_m();
}

/// How well an autopilot that is none of the simulator's followed.
void fill_tracking(Summary& summary, const SimulatedFlight& flight) {
  const auto& off_path_m = flight.recorder->off_path_m();
  const auto& brake_lag_s = flight.recorder->brake_lag_s();
  if (!flight.has_autopilot || off_path_m.empty()) {
    return;
  }
  summary.quality["off_path_m_p95"] = quantile(off_path_m, 0.95);
  summary.quality["held_percent"] =
      100.0 * static_cast<double>(flight.recorder->held()) / static_cast<double>(off_path_m.size());
  if (!brake_lag_s.empty()) {
    summary.quality["brake_lag_s_p99"] = quantile(brake_lag_s, 0.99);
  }
}

void fill_computing(Summary& summary, const SimulatedFlight& flight) {
  const MapUses& maps = flight.link->map_uses();
  const auto& navigator = flight.link->navigator();
  summary.replans = navigator ? navigator->replans : 0;
  summary.deadline_misses = flight.board.read().deadline_misses;
  summary.decisions = flight.governor->decisions();
  summary.knob_changes = flight.governor->knob_changes();
  summary.policy_faults = flight.governor->faults();
  summary.policy_trouble = flight.governor->trouble();
  summary.latency_p50_s = quantile(maps.latency_s, 0.5);
  summary.latency_p95_s = quantile(maps.latency_s, 0.95);
  summary.latency_max_s = quantile(maps.latency_s, 1.0);
  summary.maps = maps.budget_use.size();
  summary.bound_overruns = maps.overruns;
  summary.budget_use_p50 = quantile(maps.budget_use, 0.5);
  summary.latency_bounds = flight.governor->bound_levels();
  summary.decision_host_us_p50 = quantile(flight.governor->decision_host_us(), 0.5);
  summary.decision_host_us_p99 = quantile(flight.governor->decision_host_us(), 0.99);
  summary.throttle_events = flight.drift->throttle_events();
  summary.hottest_c = flight.drift->hottest_c();
  summary.kernels = flight.recorder->kernels();
  summary.quality = flight.workload->quality();
  summary.quality.merge(flight.referee->figures());
  if (const Duration late = flight.executor->longest_delay(); late > Duration::zero()) {
    summary.quality["simulator_late_s_max"] = to_seconds(late);
  }
  fill_tracking(summary, flight);
  if (const FlightLog& log = flight.loop->log(); log.measured_s > 0.0) {
    summary.quality["rotor_power_measured_percent"] = 100.0 * log.measured_s / log.airborne_s;
    if (log.reported_battery->percent) {
      summary.quality["autopilot_battery_percent"] = *log.reported_battery->percent;
    }
  }
  if (const SoftErrors& errors = *flight.soft_errors; errors.is_used()) {
    summary.quality["bit_flips"] = static_cast<double>(errors.flips());
    summary.quality["readers_lost"] = static_cast<double>(errors.lost());
    summary.quality["refused_messages"] = static_cast<double>(errors.refused());
  }
  if (const auto& localization = flight.link->localization()) {
    summary.quality["localization_lost"] = localization->times_lost;
    summary.quality["localization_lost_s"] = localization->lost_s;
  }
}

}  // namespace

Summary summary_of(const SimulatedFlight& flight, const Scenario& scenario) {
  Summary summary;
  fill_outcome(summary, flight, scenario);
  fill_computing(summary, flight);
  return summary;
}

}  // namespace flyball
