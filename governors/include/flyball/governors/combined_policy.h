// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// An application's policy and an operating system's clock rule beside it, as on a board where the
/// application does not set the clock.

#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"

#include <memory>

namespace flyball {

/// The clock is the clock rule's, every other knob the application's. Each is asked at its own
/// pace: the clock rule always, the application once per `application_period`. A faulty answer of
/// the application is passed on as it is and not kept: it is asked again at the next decision.
class CombinedPolicy final : public Policy,
                             public ChoosesPeriod,
                             public BoundsLatency,
                             public ComparesOptions,
                             public HostsCode {
 public:
  /// @param knobs  As both were started with: a wish for any other one is a faulty answer.
  /// @pre Both have been started; neither is null.
  CombinedPolicy(std::unique_ptr<Policy> application,
                 std::unique_ptr<Policy> clock,
                 Duration application_period,
                 const KnobSettings& knobs);

  [[nodiscard]] std::vector<ParameterSpec> parameters() const override { return {}; }
  Status start(const Parameters& given,
               const KnobSettings& knobs,
               const BoardModel& board) override;
  /// The shorter one of both; the clock rule's own where the application has none.
  [[nodiscard]] std::optional<Duration> period() const override;
  [[nodiscard]] Decision decide(const Observation& seen) noexcept override;
  /// The application's; none where it states no bounds.
  [[nodiscard]] BoundCount bounds() const noexcept override;
  [[nodiscard]] std::vector<LevelBounds> bound_levels() const override;
  /// The application's, when it was asked last; their clocks are those that it would have set.
  [[nodiscard]] std::vector<PolicyOption> options() const override;
  /// Of whichever was asked; the application's first.
  [[nodiscard]] std::string_view trouble() const noexcept override { return trouble_; }
  [[nodiscard]] std::string_view remark() const noexcept override { return remark_; }

 private:
  void listen(const HostsCode* host) noexcept;

  std::unique_ptr<Policy> application_;
  std::unique_ptr<Policy> clock_;
  KnobSettings knobs_;
  const BoundsLatency* bounds_;        ///< The application's; null: it states none.
  const ComparesOptions* options_;     ///< Null: the application compares none.
  const HostsCode* application_code_;  ///< Null: it hosts none.
  const HostsCode* clock_code_;
  std::optional<Duration> own_period_{};  ///< The application's.
  std::optional<Duration> clock_period_{};
  std::string_view trouble_{};
  std::string_view remark_{};
  Duration application_period_;
  Decision wish_{};  ///< The application's last one.
  std::optional<MissionTime> next_{};
};

}  // namespace flyball
