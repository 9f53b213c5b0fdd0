// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much time ahead of the vehicle a new plan is spliced into the path.

#include <deque>

namespace flyball {

/// The least lead: a path that needs no search still has to be smoothed and handed to the follower.
inline constexpr double least_plan_lead_s = 0.1;

/// The lead is 1.5 times what four of five of the last few plans took.
class PlanLead {
 public:
  void took(double plan_s, double iterations);
  /// What the last one took; 0 before the first.
  [[nodiscard]] double last_s() const { return taken_.empty() ? 0.0 : taken_.back().s; }
  /// Between .1 and 3 s.
  [[nodiscard]] double lead_s() const;
  /// Time of one iteration, over all searches of these plans; 0: they searched too little to tell.
  [[nodiscard]] double iteration_s() const;

 private:
  struct Taken {
    double s{};
    double iterations{};
  };
  std::deque<Taken> taken_{};
};

}  // namespace flyball
