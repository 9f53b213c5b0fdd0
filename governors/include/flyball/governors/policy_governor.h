// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Turns a policy into a governor: every wish becomes a legal value of an existing knob.

#include "flyball/governors/fallback_ladder.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/runtime/decision.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/observation.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

struct PolicyGovernorSettings {
  Duration min_dwell{std::chrono::milliseconds{500}};   ///< Of knobs that do not say it themselves.
  Duration time_limit{std::chrono::milliseconds{100}};  ///< Watchdog for one `decide`, host time.
  int max_faults{3};                                    ///< In a row; then the fallback for good.
  FallbackSettings fallback{};
};

/// What was wrong with a policy's answer; the record says so.
enum class PolicyFault : std::uint8_t {
  none,
  unknown_knob,
  not_finite,
  overflow,
  overtime,
  failed
};
[[nodiscard]] std::string_view to_string(PolicyFault fault);

/// Clamp (to the nearest legal value), rate limit, watchdog, fallback. A faulty answer is replaced
/// as a whole by the safe default: every knob at its default value, at once whatever the dwell.
/// What fails around the policy is met by the other steps of fallback_ladder.h.
/// The watchdog judges an answer by the time it took; it cannot interrupt one that never comes.
class PolicyGovernor final {
 public:
  /// A clock for the watchdog, in host time; it decides nothing but a fault. Null: no watchdog (the
  /// virtual executor, where missions must not depend on the host's speed).
  using HostClock = std::function<HostTime()>;

  /// @param knobs  What may be set, at the values that are in force now.
  /// @pre `policy` is not null and started; at most `Decision::capacity` knobs; `min_dwell` is not
  /// negative, `max_faults` is at least 1.
  PolicyGovernor(std::unique_ptr<Policy> policy,
                 KnobSettings knobs,
                 PolicyGovernorSettings settings,
                 HostClock clock);

  /// One wish for each knob that the policy named, in the policy's order; a wish that comes too
  /// soon after a change is answered with the value in force, and so is that of a knob that follows
  /// it. Allocates nothing.
  /// @post Every wish names an existing knob and a legal value of it.
  [[nodiscard]] Decision decide(const Observation& seen) noexcept;
  /// What the policy asked for at the last decision, before it was made legal; empty after a fault.
  [[nodiscard]] const Decision& wished() const { return wished_; }
  /// How often the policy wants to be asked; empty: as often as the scenario says.
  [[nodiscard]] std::optional<Duration> period() const;
  /// How often the policy's bounds on latency held; empty: it states none.
  [[nodiscard]] std::optional<BoundCount> bounds() const noexcept;
  /// Level by level; empty: it states none. Allocates.
  [[nodiscard]] std::vector<LevelBounds> bound_levels() const;
  /// What the policy weighed in the last decision, best first; empty: it does not compare.
  [[nodiscard]] std::vector<PolicyOption> options() const;
  [[nodiscard]] PolicyFault last_fault() const { return last_fault_; }
  [[nodiscard]] bool has_fallen_back() const { return faults_in_row_ >= settings_.max_faults; }
  /// What the last decision is, and why: one sentence, empty for `Fallback::none`.
  [[nodiscard]] Fallback fallback() const { return fallback_; }
  [[nodiscard]] std::string why() const;
  /// The same sentence without an allocation, cut off where `text` is full. @pre `size > 0`.
  void write_why(char* text, std::size_t size) const noexcept;
  /// For the bound on latency that speed follows from; 1 unless it is widened.
  [[nodiscard]] double bound_factor() const;
  /// Whether the vehicle shall brake and stand.
  [[nodiscard]] bool must_hover() const { return fallback_ == Fallback::hover; }
  /// What may be set, at the values that were in force at the start.
  [[nodiscard]] const KnobSettings& knobs() const { return knobs_; }
  /// What the policy wants the record to keep of the last decision; empty when it was not asked.
  [[nodiscard]] std::string_view remark() const;

 private:
  [[nodiscard]] Decision ask(const Observation& seen, PolicyFault& fault) noexcept;
  [[nodiscard]] PolicyFault fault_in(const Decision& wished) noexcept;
  [[nodiscard]] std::size_t index_of(std::string_view knob) const noexcept;
  [[nodiscard]] Decision made_legal(const Decision& wished, MissionTime now) noexcept;
  [[nodiscard]] Decision put_all_in_force(MissionTime now,
                                          const std::vector<double>& values) noexcept;
  [[nodiscard]] FallbackLadder::Request requested() const noexcept;
  [[nodiscard]] bool may_change(std::size_t knob, MissionTime now) const noexcept;
  [[nodiscard]] std::optional<bool> leader_changes(std::string_view leader,
                                                   const Decision& wished,
                                                   MissionTime now) const noexcept;
  void put_in_force(std::size_t knob, double value, MissionTime now) noexcept;

  std::unique_ptr<Policy> policy_;
  const ChoosesPeriod* chooses_period_;  ///< The policy, by what it can do; null: it cannot.
  const BoundsLatency* bounds_latency_;
  const ComparesOptions* compares_options_;
  const HostsCode* hosts_code_;
  KnobSettings knobs_;
  PolicyGovernorSettings settings_;
  HostClock clock_;
  std::vector<double> in_force_;                     ///< By index of the knob in `knobs_`.
  std::vector<std::optional<MissionTime>> changed_;  ///< Empty until a knob first changes.
  std::vector<double> defaults_;
  std::vector<double> table_;  ///< The defaults, with clock and cores at most.
  FallbackLadder ladder_;
  Fallback fallback_{Fallback::none};
  Decision wished_{};
  bool was_asked_{};
  std::string_view faulty_knob_{};
  PolicyFault last_fault_{PolicyFault::none};
  int faults_in_row_{};
};

}  // namespace flyball
