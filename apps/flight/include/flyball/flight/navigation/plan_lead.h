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
  void took(double plan_s, double iterations);
  /// Within .1 and 3 s.
  [[nodiscard]] double lead_s() const;
  /// Of these plans' searches together; 0: they searched too little to tell.
  [[nodiscard]] double iteration_s() const;

 private:
  struct Taken {
    double s{};
    double iterations{};
  };
  std::deque<Taken> taken_{};
};

}  // namespace flyball
