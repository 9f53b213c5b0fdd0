// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What flying takes; what computing takes, the board tells (`BoardModel`).

#include "flyball/governors/recursive_least_squares.h"
#include "flyball/runtime/units.h"

namespace flyball {

/// Rotor power in steady flight over level speed, P = c0 + c1 v + c2 v^2 [W], learned from what the
/// battery shows. MAVBench's eq. 1 (MICRO 2018) without acceleration, climb and wind is c0 = b9
/// + b7 m, c1 = b1, c2 = 0; a rotor's own curve falls first (translational lift) and rises with the
/// cube of speed later. Nothing allocates.
class RotorPower {
 public:
  struct Prior {
    double hover_w{350.0};  ///< c0: Matrice 100 with .5 kg by eq. 1.
    double linear_w_s_m{-2.595};
    double quadratic_w_s2_m2{};
    /// How wrong each may be; in watts, for noise of 30 W a sample.
    double sigma_hover_w{100.0};
    double sigma_linear_w_s_m{3.0};
    double sigma_quadratic_w_s2_m2{0.1};
  };
  RotorPower() : RotorPower(Prior{}) {}
  explicit RotorPower(const Prior& prior);

  [[nodiscard]] Watts power(double speed_m_s) const;
  /// dP/dv [W s/m].
  [[nodiscard]] double slope_w_s_m(double speed_m_s) const;
  /// A sample in flight; not finite or not positive: ignored.
  void learn(double speed_m_s, Watts measured);

 private:
  RecursiveLeastSquares<3> solver_;
};

/// Joules for each metre of progress, J = (P_rotor + P_computer) / v.
/// @pre `speed_m_s > 0`.
[[nodiscard]] double joules_per_metre(Watts rotors, Watts computer, double speed_m_s);

}  // namespace flyball
