// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How long the computer may take before it endangers the vehicle.

#include <cstddef>

namespace flyball {

/// Distance that a stop takes, without the time to react: quadratic v^2 + linear v + constant [m].
struct StoppingDistance {
  double quadratic_s2_m{};
  double linear_s{};
  double constant_m{};

  [[nodiscard]] double distance_m(double speed_m_s) const;
  /// Constant deceleration: v^2 / (2 a).
  [[nodiscard]] static StoppingDistance braking(double deceleration_m_s2);
  /// RoboRun's fit of its own vehicle's stops: .05494 v^2 + .3549 v - .2038 (DAC 2021,
  /// arXiv 2108.13354, and its code).
  [[nodiscard]] static StoppingDistance roborun();
};

/// The time until the vehicle must know more, or brake: t = share (d - stop(v)) / v, within
/// [0, cap]; RoboRun's budget, or with `braking` the latency of MAVBench's eq. 2.
struct TimeBudget {
  StoppingDistance stop{};
  double share{1.0};   ///< Of the budget that is used; RoboRun's code takes half.
  double cap_s{15.0};  ///< Also the budget of a vehicle at rest with room to stop.

  /// @param known_free_m  Along the path to the first cell that is not known free, less body and
  /// tracking error.
  /// @pre `speed_m_s >= 0`.
  [[nodiscard]] double budget_s(double speed_m_s, double known_free_m) const;
};

/// RoboRun's algorithm 1: the budget that holds along a trajectory whose way-points are `step_s`
/// apart. At each way-point what is left of the budget shrinks by the time flown and is cut to that
/// way-point's own; the sum of the times flown before it runs out is returned, and a rest.
///
/// @param local_s  Budget at way-point i as if the vehicle were there; the first is here.
/// @return 0 for no way-points.
[[nodiscard]] double rolled_budget_s(const double* local_s, std::size_t count, double step_s);

/// A trajectory that speeds up from here to what is commanded.
struct SpeedingUp {
  double speed_m_s{};          ///< Flown now.
  double commanded_m_s{};      ///< Reached at last; at once where `acceleration_m_s2` is zero.
  double acceleration_m_s2{};  ///< Not negative.
};

/// `rolled_budget_s` along such a trajectory, straight to the first cell that is not known free:
/// RoboRun's budget takes the speeds that are planned, not those of the moment, so a vehicle that
/// starts has no endless budget, nor one that flies slowly that of its largest speed. The cap and
/// the share hold for the sum.
[[nodiscard]] double budget_ahead_s(const TimeBudget& budget,
                                    const SpeedingUp& trajectory,
                                    double known_free_m);

}  // namespace flyball
