// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A C caller's loop, as tests need it: one knob for cells, one for the clock, who was called back.

#include "flyball/governors/governor.h"

#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace flyball::kit {

/// Sets a variable of the environment as long as it lives.
class Environment {
 public:
  explicit Environment(const char* name, const char* value) : name_{name} {
    setenv(name, value, 1);
  }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

inline constexpr double cells_m[] = {0.15, 0.40, 0.80};
inline constexpr double clocks_hz[] = {0.5e9, 1.0e9, 2.0e9};

class GovernedLoop {
 public:
  explicit GovernedLoop() : governor{flyball_governor_create()} {}
  ~GovernedLoop() { flyball_governor_close(governor); }
  GovernedLoop(const GovernedLoop&) = delete;
  GovernedLoop& operator=(const GovernedLoop&) = delete;

  /// A knob for cells as `density` wants it.
  [[nodiscard]] FlyballGovernorKnob cell_knob() {
    FlyballGovernorKnob knob{};
    knob.struct_size = sizeof knob;
    knob.name = "map.resolution_m";
    knob.unit = "m";
    knob.description = "Edge of a cell";
    knob.legal = cells_m;
    knob.legal_count = 3;
    knob.start = 0.15;
    knob.apply = [](void* self, double value) {
      return static_cast<GovernedLoop*>(self)->set_cells(value);
    };
    knob.context = this;
    return knob;
  }
  [[nodiscard]] FlyballGovernorKnob clock_knob() {
    FlyballGovernorKnob knob = cell_knob();
    knob.name = "cpu.frequency_hz";
    knob.unit = "Hz";
    knob.description = "Clock of the cores";
    knob.legal = clocks_hz;
    knob.start = 1.0e9;
    knob.apply = nullptr;
    return knob;
  }
  [[nodiscard]] static FlyballGovernorStage stage(const char* name) {
    FlyballGovernorStage one{};
    one.struct_size = sizeof one;
    one.name = name;
    return one;
  }
  [[nodiscard]] FlyballGovernorSettings settings(const char* policy) {
    FlyballGovernorSettings all{};
    all.struct_size = sizeof all;
    all.policy = policy;
    all.record = [](void* self, const char* line) {
      static_cast<GovernedLoop*>(self)->lines.emplace_back(line);
    };
    all.context = this;
    return all;
  }
  std::int32_t add(const FlyballGovernorKnob& knob) {
    return flyball_governor_add_knob(governor, &knob);
  }
  std::int32_t add(const FlyballGovernorStage& one) {
    return flyball_governor_add_stage(governor, &one);
  }
  std::int32_t open(const FlyballGovernorSettings& all) {
    return flyball_governor_open(governor, &all);
  }
  /// With the knob for cells, the policy `density`, in cruise.
  std::int32_t open_density() {
    add(cell_knob());
    const std::int32_t opened = open(settings("density"));
    observe("phase", flyball_governor_cruise);
    return opened;
  }
  std::int32_t observe(const char* signal, double value) {
    return flyball_governor_observe(governor, signal, value);
  }
  FlyballGovernorDecision decide(double now_s) {
    FlyballGovernorDecision decision{};
    decision.struct_size = sizeof decision;
    code = flyball_governor_decide(governor, now_s, &decision);
    return decision;
  }
  [[nodiscard]] std::string error() const { return flyball_governor_last_error(governor); }
  /// Everything that can be listed, by its name.
  [[nodiscard]] std::map<std::string, FlyballGovernorEntry> list() const {
    std::map<std::string, FlyballGovernorEntry> all;
    FlyballGovernorEntry entry{};
    entry.struct_size = sizeof entry;
    for (std::uint32_t i = 0; flyball_governor_list(governor, i, &entry) == flyball_governor_ok;
         ++i) {
      all[entry.name] = entry;
    }
    return all;
  }
  [[nodiscard]] double signal(const std::string& name) const { return list().at(name).value; }

  FlyballGovernor* governor;
  std::int32_t code{};            ///< Of the last `decide`.
  std::vector<double> applied{};  ///< Each cell size that was asked for.
  std::vector<std::string> lines{};
  std::int32_t refusal{};  ///< What the callback returns.
  double granted{};        ///< What it says was granted; 0: what was asked for.

 private:
  std::int32_t set_cells(double value) {
    applied.push_back(value);
    if (granted != 0.0) {
      flyball_governor_granted(governor, "map.resolution_m", granted);
    }
    return refusal;
  }
};

}  // namespace flyball::kit
