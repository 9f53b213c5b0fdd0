// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The outer loop: observe, decide, apply, record.

#include "flyball/governors/policy_governor.h"

#include "closed_loop.h"
#include "navigator.h"
#include <set>
#include <string>

namespace flyball {

class GovernorLoop {
 public:
  /// All arguments outlive the loop; `navigator` may be null.
  GovernorLoop(MissionContext& context,
               PolicyGovernor& governor,
               VirtualExecutor& executor,
               const ClosedLoop& loop,
               const Navigator* navigator);

  /// One decision at `now`.
  void tick(MissionTime now);
  /// A deadline was missed; told with the next observation.
  void count_miss() {
    ++misses_;
    ++all_misses_;
  }
  [[nodiscard]] std::uint64_t decisions() const { return decisions_; }
  [[nodiscard]] std::uint64_t knob_changes() const { return knob_changes_; }
  [[nodiscard]] std::uint64_t faults() const { return faults_; }
  [[nodiscard]] std::uint64_t misses() const { return all_misses_; }

 private:
  [[nodiscard]] Observation observe(MissionTime now);
  void record(const Observation& seen);
  void observe_computer(MissionTime now, Observation& seen);
  void apply(MissionTime now, const Decision& decision);
  void note_moved_wishes(MissionTime now);

  MissionContext& context_;
  PolicyGovernor& governor_;
  VirtualExecutor& executor_;
  const ClosedLoop& loop_;
  const Navigator* navigator_;
  MissionTime last_{};
  double last_busy_core_s_{};
  std::uint64_t last_drops_{};
  std::uint32_t misses_{};
  std::uint64_t all_misses_{};
  std::uint64_t decisions_{};
  std::uint64_t knob_changes_{};
  std::uint64_t faults_{};
  std::set<std::string> moved_{};  ///< Knobs whose wishes had to be moved to a legal value.
};

}  // namespace flyball
