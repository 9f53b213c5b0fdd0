// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// An application's policy and an operating system's clock rule beside it, as on a board where the
/// application does not set the clock.

#include "flyball/governors/policy.h"

#include <memory>

namespace flyball {

/// The clock is the clock rule's, every other knob the application's. Each is asked at its own
/// pace: the clock rule always, the application once per `application_period`.
class CombinedPolicy final : public Policy {
 public:
  /// @pre Both have been started; neither is null.
  CombinedPolicy(std::unique_ptr<Policy> application,
                 std::unique_ptr<Policy> clock,
                 Duration application_period);

  [[nodiscard]] std::vector<ParameterSpec> parameters() const override { return {}; }
  Status start(const Parameters& given,
               const KnobSettings& knobs,
               const BoardModel& board) override;
  /// The shorter one of both; the clock rule's own where the application has none.
  [[nodiscard]] std::optional<Duration> period() const override;
  [[nodiscard]] Decision decide(const Observation& seen) noexcept override;
  /// The application's.
  [[nodiscard]] std::optional<PromiseCount> promises() const noexcept override {
    return application_->promises();
  }
  [[nodiscard]] std::vector<LevelPromises> promise_levels() const override {
    return application_->promise_levels();
  }

 private:
  std::unique_ptr<Policy> application_;
  std::unique_ptr<Policy> clock_;
  Duration application_period_;
  Decision wish_{};  ///< The application's last one.
  std::optional<MissionTime> next_{};
};

}  // namespace flyball
