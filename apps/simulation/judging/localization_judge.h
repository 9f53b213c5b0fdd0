// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How far the vehicle's estimate of its pose is from the truth.

#include "flyball/runtime/executor.h"
#include "flyball/runtime/messages.h"

#include "simulation/judging/judge.h"
#include <deque>

namespace flyball {

class LocalizationJudge final : public Judge {
 public:
  /// The executor outlives the judge, which listens to the topic from now on.
  LocalizationJudge(Executor& executor, Topic<PoseEstimate> pose);

  /// Where the vehicle truly was when a navigation sample was taken.
  void note(const TruePose& pose);
  /// `localization_error_m_mean`, `localization_error_m_max`; without an estimate none.
  [[nodiscard]] std::map<std::string, double> figures() const override;

 private:
  void compare(const PoseEstimate& estimate);

  std::deque<TruePose> poses_{};  ///< Of the last seconds, oldest first.
  double error_sum_m_{};
  double error_max_m_{};
  std::uint64_t compared_{};
};

}  // namespace flyball
