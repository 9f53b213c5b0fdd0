// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What only some policies can do: interfaces that a policy implements beside `Policy`. Its
/// governor asks for them once, when it takes the policy over.

#include "flyball/runtime/decision.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace flyball {

class PolicyAbility {
 public:
  PolicyAbility() = default;
  PolicyAbility(const PolicyAbility&) = delete;
  PolicyAbility& operator=(const PolicyAbility&) = delete;
  virtual ~PolicyAbility() = default;
};

/// It says itself how often it wants to be asked.
class ChoosesPeriod : public PolicyAbility {
 public:
  /// Empty: as often as the scenario says. Asked once, when it has started.
  [[nodiscard]] virtual std::optional<Duration> period() const = 0;
};

/// One of the settings that a policy weighed, with what it expects of it.
struct PolicyOption {
  Decision setting{};
  double speed_m_s{};
  double joules_per_m{};
  double response_s{};        ///< Sensor to brake.
  double watts_per_second{};  ///< Worth of one second of latency; 0 where it limits nothing.
};

/// It compares settings and can show what it expected of each.
class ComparesOptions : public PolicyAbility {
 public:
  /// What it weighed in the last `decide`, best first. For people who ask afterwards, not in
  /// flight: may allocate.
  [[nodiscard]] virtual std::vector<PolicyOption> options() const = 0;
};

/// How often a policy's bounds on latency held.
struct BoundCount {
  std::uint64_t issued{};  ///< Bounds that are settled: the result came, or its time ran out.
  std::uint64_t late{};    ///< Violated ones among them.
  double factor{1.0};      ///< Of the next bound over the latency that is predicted.
};

/// The same at one level of map resolution, for people who ask when the mission is over.
struct LevelBounds {
  double resolution_m{};
  std::uint64_t issued{};
  std::uint64_t late{};
  std::optional<double> most_late{};  ///< By what the policy states; empty: it states nothing.
};

/// It bounds the latency of the next map from above, and counts how often that bound is violated.
class BoundsLatency : public PolicyAbility {
 public:
  [[nodiscard]] virtual BoundCount bounds() const noexcept = 0;
  /// Level by level; may allocate.
  [[nodiscard]] virtual std::vector<LevelBounds> bound_levels() const = 0;
};

/// A policy that hosts code from outside, whose faults show only when it is asked.
class HostsCode : public PolicyAbility {
 public:
  /// Why the last `decide` came to nothing, in one sentence; empty: it did not.
  [[nodiscard]] virtual std::string_view trouble() const noexcept = 0;
  /// What the record shall keep of the last `decide`, in the code's own words; empty: nothing.
  [[nodiscard]] virtual std::string_view remark() const noexcept = 0;
};

}  // namespace flyball
