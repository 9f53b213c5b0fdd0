// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flyball/simulation/mission.h"

#include <memory>
#include <string>
#include <utility>

namespace flyball {

/// A flight that succeeded, with a different number in every field.
inline Summary made_summary(const std::string& policy, std::uint64_t seed) {
  Summary summary;
  summary.scenario = "made";
  summary.policy = policy;
  summary.seed = seed;
  summary.status = MissionStatus::succeeded;
  summary.mission_time_s = 100.0;
  summary.energy_rotor_j = 30000.5;
  summary.energy_computer_j = 1000.25;
  summary.battery_start_percent = 100.0;
  summary.battery_end_percent = 80.0;
  summary.distance_m = 201.0 / 3.0;
  summary.mean_speed_m_s = 2.01;
  summary.max_speed_m_s = 5.5;
  summary.hover_time_s = 12.5;
  summary.replans = 7;
  summary.deadline_misses = 8;
  summary.decisions = 400;
  summary.knob_changes = 9;
  summary.policy_faults = 10;
  summary.policy_trouble = "threw: <enough>";
  summary.latency_p50_s = 0.11;
  summary.latency_p95_s = 0.22;
  summary.latency_max_s = 0.33;
  summary.maps = 55;
  summary.bound_overruns = 3;
  summary.budget_use_p50 = 0.66;
  summary.latency_bounds = {{0.15, 40, 2, 3.5}, {0.3, 10, 1, std::nullopt}};
  summary.decision_host_us_p50 = 1.5;
  summary.decision_host_us_p99 = 2.75;
  summary.throttle_events = 2;
  summary.hottest_c = 81.5;
  summary.min_clearance_m = 0.44;
  summary.kernels["octomap"] = {123, 45.6, 78.9, 1.25};
  summary.quality["area_covered_percent"] = 97.25;
  summary.host_s = 3.5;
  summary.real_time_factor = 28.5;
  summary.trace_hash = "0123456789abcdef";
  summary.numeric_fingerprint = "fedcba9876543210";
  summary.version = "0.0.0";
  return summary;
}

/// Two seconds of flight along x in a world with one box and one pillar in the way, and a ceiling.
inline MissionRecord made_record(const std::string& policy, std::uint64_t seed) {
  MissionRecord record;
  record.summary = made_summary(policy, seed);
  record.world.bounds_W = {Vec3{-5, -5, 0.9}, Vec3{15, 5, 1.7}};
  record.world.boxes = {{Vec3{2, 1, 0}, Vec3{3, 2, 3}}, {Vec3{-5, -5, 2.5}, Vec3{15, 5, 2.7}}};
  record.world.pillars = {{Vec3{6, -2, 0}, 0.25, 4.0}};
  record.world.goal_W = Vec3{10, 0, 0};
  record.trace = std::make_shared<MemoryRecorder>();
  for (int i = 0; i <= 20; ++i) {
    const double t_s = 0.1 * i;
    record.trace->record(MissionTime{from_seconds(t_s)}, "state",
                         {{"x_m", 5.0 * t_s},
                          {"y_m", 1.0 / 3.0},
                          {"speed_m_s", 5.0},
                          {"set_speed_m_s", 5.5},
                          {"resolution_m", 0.15},
                          {"latency_bound_s", 0.2},
                          {"rotor_w", 350.0},
                          {"computer_w", 9.0},
                          {"battery_percent", 100.0 - t_s},
                          {"phase", std::string{"cruise"}}});
  }
  record.trace->record(MissionTime{from_seconds(2.0)}, "event",
                       {{"what", std::string{"\"</script>\" ends\nit"}}});
  return record;
}

}  // namespace flyball
