// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Policies that turn nothing in flight but the clock: an operating system's governors.

#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/runtime/registry.h"

#include <memory>
#include <string>

namespace flyball {

/// The clocks that may be chosen, ascending, and Linux's three ways to round to one of them.
class ClockTable {
 public:
  ClockTable() = default;
  /// @pre Not empty, ascending.
  explicit ClockTable(std::vector<double> clocks_hz);
  [[nodiscard]] double lowest_hz() const { return clocks_hz_.front(); }
  [[nodiscard]] double highest_hz() const { return clocks_hz_.back(); }
  [[nodiscard]] double at_or_above_hz(double wish_hz) const;  ///< CPUFREQ_RELATION_L.
  [[nodiscard]] double at_or_below_hz(double wish_hz) const;  ///< CPUFREQ_RELATION_H.
  [[nodiscard]] double nearest_hz(double wish_hz) const;      ///< CPUFREQ_RELATION_C.

 private:
  std::vector<double> clocks_hz_{};
};

/// What an operating system knows when it samples.
struct ClockSample {
  MissionTime now{};
  double elapsed_s{};  ///< Since the last sample, above 0.
  double load{};       ///< Of the busiest core, 0..1.
  double clock_hz{};   ///< In force; one of the table.
  /// Those that may be chosen.
  const ClockTable& clocks;
};

/// A rule for the clock alone.
class ClockRule {
 public:
  ClockRule() = default;
  ClockRule(const ClockRule&) = delete;
  ClockRule& operator=(const ClockRule&) = delete;
  virtual ~ClockRule() = default;

  /// What a preset may set besides the sampling period and the applications' knobs.
  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const { return {}; }
  /// False for a rule that looks at nothing: it has no sampling period.
  [[nodiscard]] virtual bool samples() const { return true; }
  virtual Status start(const Parameters& /*given*/, const ClockTable& /*clocks*/) { return Done{}; }
  /// One of the table's clocks.
  [[nodiscard]] virtual double next_hz(const ClockSample& sample) noexcept = 0;
};

/// A clock rule as a policy: `cpu.frequency_hz` is the rule's, the other knobs stay where
/// parameters of `fixed_settings.h` put them. `sampling_period_s` is required, because with another
/// period these rules are other rules.
class ClockPolicy final : public Policy, public ChoosesPeriod {
 public:
  /// @pre `rule` is not null.
  ClockPolicy(std::string name, std::unique_ptr<ClockRule> rule);

  [[nodiscard]] std::vector<ParameterSpec> parameters() const override;
  Status start(const Parameters& given,
               const KnobSettings& knobs,
               const BoardModel& board) override;
  [[nodiscard]] std::optional<Duration> period() const override { return period_; }
  [[nodiscard]] Decision decide(const Observation& seen) noexcept override;

 private:
  [[nodiscard]] double clock_hz(const Observation& seen) noexcept;

  std::string name_;
  std::unique_ptr<ClockRule> rule_;
  ClockTable clocks_{};
  Decision fixed_{};
  std::optional<Duration> period_{};
  std::optional<MissionTime> last_{};
  double in_force_hz_{};
};

/// Registers a rule as a policy of this name.
template <class Rule>
void add_clock_policy(Registry& registry, const char* name) {
  registry.add<Policy>(
      name, [name] { return std::make_unique<ClockPolicy>(name, std::make_unique<Rule>()); });
}

}  // namespace flyball
