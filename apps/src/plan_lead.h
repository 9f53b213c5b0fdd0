// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How far ahead of the vehicle a plan is spliced in.

#include <deque>

namespace flyball {

/// What a path needs that nobody has to look for: it is smoothed, and told to the vehicle.
inline constexpr double least_plan_lead_s = 0.1;

/// What four of five of the last few plans took, and half as much again.
class PlanLead {
 public:
  void took(double plan_s);
  /// Within .1 and 3 s.
  [[nodiscard]] double lead_s() const;

 private:
  std::deque<double> taken_s_{};
};

}  // namespace flyball
