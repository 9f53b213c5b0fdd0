// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Turns a policy into a governor: every wish becomes a legal value of an existing knob.

#include "flyball/governors/policy.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace flyball {

struct PolicyGovernorSettings {
  Duration min_dwell{std::chrono::milliseconds{500}};  ///< A knob changes at most this often.
  Duration time_limit{std::chrono::milliseconds{100}}; ///< Watchdog for one `decide`, host time.
  int max_faults{3};                                   ///< In a row; then the fallback for good.
};

/// What was wrong with a policy's answer; the record says so.
enum class PolicyFault : std::uint8_t { none, unknown_knob, not_finite, overflow, overtime };
[[nodiscard]] std::string_view to_string(PolicyFault fault);

/// Clamp (to the nearest legal value), rate limit, watchdog, fallback. A faulty answer is replaced
/// as a whole by the safe default: every knob at its default value.
class PolicyGovernor final : public Governor {
 public:
  /// A clock for the watchdog, in host time; it decides nothing but a fault. Null: no watchdog (the
  /// virtual executor, where missions must not depend on the host's speed).
  using HostClock = std::function<HostTime()>;

  /// @pre `policy` is not null and started.
  PolicyGovernor(std::unique_ptr<Policy> policy, KnobSettings knobs, PolicyGovernorSettings settings, HostClock clock);

  [[nodiscard]] Decision decide(const Observation& seen) noexcept override;
  [[nodiscard]] PolicyFault last_fault() const { return last_fault_; }
  [[nodiscard]] bool has_fallen_back() const { return faults_in_row_ >= settings_.max_faults; }

 private:
  std::unique_ptr<Policy> policy_;
  KnobSettings knobs_;
  PolicyGovernorSettings settings_;
  HostClock clock_;
  std::vector<double> in_force_;
  std::vector<MissionTime> changed_;
  PolicyFault last_fault_{PolicyFault::none};
  int faults_in_row_{};
};

}  // namespace flyball
