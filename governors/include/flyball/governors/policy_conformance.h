// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of policy.h as checks, for any policy and any test framework: an empty list of
/// breaches means that the policy may fly.

#include "flyball/governors/policy_governor.h"
#include "flyball/runtime/random.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// The knobs that a mission of this project has, with a TX2's operating points.
[[nodiscard]] inline KnobSettings conformance_knobs() {
  return KnobSettings{{
      {"map.resolution_m", "m", "mapper", {0.15, 0.30, 0.60, 0.80, 1.20}, 0.15, 1.20, 0.15, ""},
      {"map.range_m", "m", "mapper", {}, 2.0, 25.0, 7.0, "", std::nullopt, {}, "map.resolution_m"},
      {"map.rate_hz", "Hz", "mapper", {}, 1.0, 30.0, 20.0, ""},
      {"planner.budget", "iterations", "plan", {}, 100.0, 1e6, 40000.0, ""},
      {"explore.iterations", "nodes", "explore", {}, 1.0, 10000.0, 15.0, ""},
      {"explore.threads", "threads", "explore", {1, 2, 3, 4}, 1.0, 4.0, 1.0, ""},
      {"cpu.cores", "", "platform", {1, 2, 3, 4}, 1.0, 4.0, 4.0, ""},
      {"cpu.frequency_hz", "Hz", "platform", {806.4e6, 1574.4e6, 2035.2e6}, 0.0, 0.0, 2035.2e6, ""},
      {"mission.max_speed_m_s", "m/s", "mission", {}, 0.5, 10.0, 10.0, ""},
  }};
}

/// A computer with the clocks of these knobs; round numbers, as a small board may have them.
[[nodiscard]] inline BoardModel conformance_board() {
  PowerCost power;
  power.board_w = 0.5;
  power.converter = 1.25;
  power.soc_w = 0.5;
  power.memory_w = 0.2;
  power.memory_linear_w = 0.4;
  power.memory_clocks = {{Hertz{0.0}, Hertz{0.5e9}}, {Hertz{1e9}, Hertz{1.5e9}}};
  power.cpu_constant_w = 0.2;
  power.cpu_linear_w = 0.05;
  power.core_linear_w = 0.1;
  power.core_cubic_w = 0.1;
  return {4,
          {Hertz{806.4e6}, Hertz{1574.4e6}, Hertz{2035.2e6}},
          std::chrono::microseconds{300},
          power,
          ThermalModel{40.0, 8.0, 500.0, {{80.0, 2.0, Hertz{806.4e6}}}}};
}

struct PolicyCandidate {
  std::function<std::unique_ptr<Policy>()> make;
  std::map<std::string, ParameterValue> parameters{};  ///< As a preset would give them.
  /// Allocations of this thread until now, see counting_new.h. Empty: that check is left out.
  std::function<std::size_t()> allocations{};
  KnobSettings knobs = conformance_knobs();  ///< An application with knobs of its own names them.
  BoardModel board = conformance_board();
};

/// What is given, and its example for each required parameter that is not.
[[nodiscard]] inline std::map<std::string, ParameterValue> with_examples(
    const std::vector<ParameterSpec>& specs, std::map<std::string, ParameterValue> given) {
  for (const ParameterSpec& spec : specs) {
    if (spec.required) {
      given.emplace(spec.name, spec.fallback);
    }
  }
  return given;
}

/// A mission's worth of observations that a vehicle may well make, every quarter of a second.
[[nodiscard]] inline std::vector<Observation> plausible_observations(std::size_t count) {
  RandomStream draw{1, "policy_conformance"};
  std::vector<Observation> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    Observation& seen = all[i];
    seen.now = MissionTime{std::chrono::milliseconds{250} * static_cast<int>(i)};
    seen.phase = static_cast<MissionPhase>(draw.next() % 4);
    seen.speed_m_s = draw.uniform(0.0, 10.0);
    seen.known_free_m = draw.uniform(0.0, 25.0);
    seen.obstacle_density = std::pow(draw.uniform(), 3.0);
    seen.density_ahead = std::pow(draw.uniform(), 3.0);
    seen.speed_limit_m_s = draw.uniform() < 0.3 ? 1.0 : 10.0;
    seen.nearest_obstacle_m = draw.uniform(0.3, 20.0);
    seen.distance_to_goal_m = draw.uniform(0.0, 400.0);
    seen.tracking_error_m = draw.uniform(0.0, 0.3);
    seen.map_resolution_m = draw.uniform() < 0.5 ? 0.15 : 0.80;
    seen.map_revision = i;
    seen.latency = from_seconds(draw.uniform(0.01, 3.0));
    seen.latency_bound = from_seconds(1.1 * to_seconds(seen.latency));
    seen.deadline_misses = static_cast<std::uint32_t>(draw.next() % 3);
    seen.planner_failures = static_cast<std::uint32_t>(draw.next() % 4);
    seen.cores = 1 + static_cast<int>(draw.next() % 4);
    seen.frequency = Hertz{draw.uniform() < 0.5 ? 806.4e6 : 2035.2e6};
    seen.busy_cores = draw.uniform(0.0, seen.cores);
    seen.busiest_core_load = std::min(1.0, seen.busy_cores);
    seen.computer_power = Watts{draw.uniform(2.0, 15.0)};
    seen.rotor_power = Watts{draw.uniform(150.0, 600.0)};
    seen.battery_percent = draw.uniform(0.0, 100.0);
    seen.max_deceleration_m_s2 = draw.uniform(1.0, 8.0);
    seen.narrowest_gap_m = draw.uniform(0.0, 24.0);
    seen.gap_distance_m = draw.uniform(0.0, 24.0);
    seen.mean_gap_m = draw.uniform(seen.narrowest_gap_m, 24.0);
    seen.temperature_c = draw.uniform(20.0, 90.0);
    seen.trip_c = draw.uniform(0.0, 1.0) < 0.5 ? 0.0 : draw.uniform(60.0, 95.0);
    seen.map_age = seen.latency + from_seconds(draw.uniform(0.0, 1.0));
    seen.headroom_m = draw.uniform(0.0, 5.0);
    seen.progress_unit = static_cast<ProgressUnit>(draw.next() % 5);
    seen.progress = 0.25 * static_cast<double>(i);
    seen.cpu_power = Watts{draw.uniform(0.0, 0.5) * seen.computer_power.value()};
    seen.map_within = from_seconds(draw.uniform(0.0, 3.0));
    seen.slower_zone_m = draw.uniform(0.0, 40.0);
    seen.map_range_m = draw.uniform(0.0, 25.0);
    for (StageUse& stage : seen.stages) {
      stage = {from_seconds(draw.uniform(0.0, 3.0)), draw.uniform(0.0, 2.0),
               draw.uniform(0.0, 6.0)};
    }
  }
  return all;
}

/// What broken sensors and estimators produce: every number at one extreme, one after another.
[[nodiscard]] inline std::vector<Observation> extreme_observations() {
  using Limits = std::numeric_limits<double>;
  constexpr auto most = std::numeric_limits<std::uint32_t>::max();
  std::vector<Observation> all;
  for (const double x : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
                         Limits::max(), Limits::lowest(), Limits::denorm_min(), -1.0, 0.0}) {
    Observation seen;
    seen.now = MissionTime{std::chrono::hours{all.size()}};
    seen.phase = MissionPhase::cruise;  // Before a mission has begun no policy is asked.
    seen.speed_m_s = seen.known_free_m = seen.obstacle_density = seen.nearest_obstacle_m = x;
    seen.distance_to_goal_m = seen.tracking_error_m = seen.map_resolution_m = x;
    seen.busy_cores = seen.busiest_core_load = seen.battery_percent = x;
    seen.density_ahead = seen.speed_limit_m_s = x;
    seen.max_deceleration_m_s2 = x;
    seen.narrowest_gap_m = seen.gap_distance_m = seen.mean_gap_m = x;
    seen.temperature_c = seen.trip_c = x;
    seen.map_revision = all.size();
    seen.frequency = Hertz{x};
    seen.computer_power = seen.rotor_power = Watts{x};
    seen.latency = seen.latency_bound = seen.map_age = seen.map_within =
        std::chrono::hours{x < 0.0 ? -24 : 24};
    seen.deadline_misses = seen.queue_drops = seen.planner_failures = most;
    seen.cores = x < 0.0 ? -1 : 1 << 30;
    seen.headroom_m = seen.progress = seen.slower_zone_m = seen.map_range_m = x;
    seen.cpu_power = seen.gpu_power = seen.memory_power = seen.soc_power = Watts{x};
    seen.stages.fill({seen.latency, x, x});
    all.push_back(seen);
  }
  return all;
}

/// Checks one policy; `breaches()` collects one sentence for each thing that it gets wrong.
class PolicyConformance {
 public:
  explicit PolicyConformance(PolicyCandidate candidate) : candidate_{std::move(candidate)} {}

  [[nodiscard]] std::vector<std::string> breaches() {
    breaches_.clear();
    has_trouble_ = false;
    if (!starts()) {
      return breaches_;
    }
    check_parameters();
    check_wishes();
    if (has_trouble_) {
      return breaches_;  // The rest would say the same again, some of it after a long wait.
    }
    check_repeatable();
    check_allocations();
    check_legal_under_governor(plausible_observations(400), true);
    check_legal_under_governor(extreme_observations(), false);
    return breaches_;
  }

 private:
  void require(bool holds, const std::string& breach) {
    if (!holds && std::find(breaches_.begin(), breaches_.end(), breach) == breaches_.end()) {
      breaches_.push_back(breach);
    }
  }

  /// Null, with the reason among the breaches, when it does not start.
  std::unique_ptr<Policy> started() {
    auto policy = candidate_.make();
    if (policy == nullptr) {
      require(false, "the factory makes nothing");
      return nullptr;
    }
    const auto given = Parameters::resolve(
        "policy", policy->parameters(), with_examples(policy->parameters(), candidate_.parameters));
    if (const auto* errors = std::get_if<std::vector<Error>>(&given)) {
      for (const Error& error : *errors) {
        require(false, "does not take the given parameters: " + error.message);
      }
      return nullptr;
    }
    const Status status =
        policy->start(std::get<Parameters>(given), candidate_.knobs, candidate_.board);
    if (!status.ok()) {
      require(false, "does not start: " + status.error().message);
      return nullptr;
    }
    return policy;
  }

  bool starts() { return started() != nullptr; }

  void check_parameters() {
    for (const ParameterSpec& spec : candidate_.make()->parameters()) {
      require(!spec.name.empty() && !spec.description.empty(),
              "parameter \"" + spec.name + "\" lacks a name or a description");
      if (const double* value = std::get_if<double>(&spec.fallback)) {
        require(*value >= spec.min && *value <= spec.max,
                "the default of \"" + spec.name + "\" is out of its own bounds");
      }
    }
  }

  void check_wishes() {
    const auto policy = started();
    const KnobSettings& knobs = candidate_.knobs;
    for (const Observation& seen : plausible_observations(400)) {
      const Decision wished = policy->decide(seen);
      const auto* host = dynamic_cast<const HostsCode*>(policy.get());
      if (host != nullptr && !host->trouble().empty()) {
        has_trouble_ = true;
        require(false, "cannot decide: " + std::string{host->trouble()});
        return;
      }
      require(!wished.overflowed(), "wishes more than a decision holds");
      for (const auto& [knob, value] : wished) {
        require(knobs.spec(knob) != nullptr, "names no knob: \"" + std::string{knob} + "\"");
        require(std::isfinite(value),
                "wishes a number that is not finite for " + std::string{knob});
      }
    }
  }

  static bool equal(const Decision& a, const Decision& b) {
    return a.reason == b.reason &&
           std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
             const bool both_nan = std::isnan(x.value) && std::isnan(y.value);
             return x.knob == y.knob && (both_nan || x.value == y.value);
           });
  }

  /// Two of a kind that saw the same decide the same.
  void check_repeatable() {
    const auto one = started();
    const auto other = started();
    for (const Observation& seen : plausible_observations(400)) {
      require(equal(one->decide(seen), other->decide(seen)), "decides differently on equal input");
    }
  }

  void check_allocations() {
    if (!candidate_.allocations) {
      return;
    }
    const auto policy = started();
    const auto observations = plausible_observations(400);
    const std::size_t before = candidate_.allocations();
    for (const Observation& seen : observations) {
      static_cast<void>(policy->decide(seen));
    }
    const std::size_t after = candidate_.allocations();
    require(after == before, "allocates in decide()");
  }

  void check_legal_under_governor(const std::vector<Observation>& observations, bool plausible) {
    const KnobSettings& knobs = candidate_.knobs;
    PolicyGovernorSettings settings;
    settings.fallback.enabled = false;  // The policy shall answer, not what stands in for it.
    PolicyGovernor governor{started(), knobs, settings, {}};
    for (const Observation& seen : observations) {
      for (const auto& [knob, value] : governor.decide(seen)) {
        const KnobSpec* spec = knobs.spec(knob);
        require(spec != nullptr && spec->is_legal(value), "is not legal even after the governor");
      }
      require(!plausible || governor.last_fault() == PolicyFault::none,
              "answers a plausible observation with a fault: " +
                  std::string{to_string(governor.last_fault())});
    }
  }

  PolicyCandidate candidate_;
  std::vector<std::string> breaches_;
  bool has_trouble_{};
};

}  // namespace flyball
