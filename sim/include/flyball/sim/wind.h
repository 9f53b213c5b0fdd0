// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Wind: a steady mean, and gusts with Dryden's spectra.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/random.h"

#include <cstdint>

namespace flyball {

/// Of the gusts at one height: MIL-F-8785C, low altitude model.
struct GustScale {
  double level_m{};       ///< L_u = L_v: along the mean wind and level across it.
  double vertical_m{};    ///< L_w
  double level_m_s{};     ///< sigma_u = sigma_v
  double vertical_m_s{};  ///< sigma_w
};

/// Heights below 10 ft and above 1000 ft count as these.
/// @param wind_20ft_m_s  Mean wind 20 ft above the ground: 15 kn (7.7 m/s) for light turbulence, 30
///                       for moderate, 45 for severe.
[[nodiscard]] GustScale gust_scale(double height_m, double wind_20ft_m_s);

struct WindSpec {
  Vec3 mean_W{Vec3::Zero()};  ///< Where it blows to [m/s].
  double gust_wind_m_s{};     ///< At 20 ft, which decides how strong gusts are. Zero: none.
};

/// The gusts stand still in the moving air (Taylor's frozen field), so that they pass at the speed
/// of the vehicle through it. One sample per time step, with the spectrum's own autocorrelation:
/// sigma^2 e^(-r/L) along, sigma^2 e^(-r/L) (1 - r/2L) across and upwards, r the distance flown
/// through the air.
class Wind {
 public:
  Wind(const WindSpec& spec, std::uint64_t seed);

  /// @param height_m  Above the ground.
  void advance(double dt_s, double height_m, const Vec3& v_WB);
  /// Mean and gust, now.
  [[nodiscard]] const Vec3& velocity_W() const { return velocity_W_; }

 private:
  /// Filter states of one transverse component, in units of sigma.
  struct Transverse {
    double fast{};
    double slow{};
    void start(RandomStream& noise);
    void pass(double lengths, RandomStream& noise);
    [[nodiscard]] double value() const;
  };

  WindSpec spec_;
  RandomStream noise_;
  Vec3 along_W_{Vec3::UnitX()};  ///< Of the mean wind; eastwards without one.
  double along_{};               ///< In units of sigma.
  Transverse across_{};
  Transverse up_{};
  Vec3 velocity_W_;
};

}  // namespace flyball
