// flyball-package: mrpt-topography
// SPDX-License-Identifier: BSD-3-Clause
//
// Satellite fixes, with the Doppler velocity in between and the flight controller's attitude.
// A complementary filter: the velocity carries the position, the fixes pull it back.

#include "flyball/kernels/localizer.h"
#include "flyball/kernels/module.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

namespace {

using flyball::Vec3;

// Steady-state Kalman gain for 5 cm of white noise on a fix, and 5 cm/s on the velocity held for
// the .1 s between fixes: q/r = (.005/.05)^2, gain = (-q/r + sqrt((q/r)^2 + 4 q/r)) / 2 = .095.
constexpr double usual_gain = 0.1;
// Chosen: no vehicle gets so far from its origin. A place that is pulled in from beyond it, or that
// is not finite at all, would spoil the estimate for minutes or for ever.
constexpr double farthest_m = 1e6;

/// What kernels/modules/geodesy.cpp offers.
using GeodeticToEnu = bool (*)(const double* place, const double* origin, double* p_W);

GeodeticToEnu load_conversion() {
  void* function = flyball::module_function("geodesy", "flyball_geodetic_to_enu");
  return reinterpret_cast<GeodeticToEnu>(function);  // NOLINT: what dlsym is for
}

/// Empty for a fix that is none: a receiver that lost its satellites, or a damaged message. Finite
/// coordinates may still overflow where they are converted.
std::optional<Vec3> to_world(GeodeticToEnu convert,
                             const flyball::NavigationSample& sample,
                             const flyball::GeodeticOrigin& origin) {
  if (!sample.has_fix || !std::isfinite(sample.latitude_rad) ||
      !std::isfinite(sample.longitude_rad) || !std::isfinite(sample.height_m) ||
      !sample.v_gps_W.allFinite()) {
    return std::nullopt;
  }
  const std::array place{sample.latitude_rad, sample.longitude_rad, sample.height_m};
  const std::array centre{origin.latitude_rad, origin.longitude_rad, origin.height_m};
  Vec3 p_W;
  const bool is_place = convert(place.data(), centre.data(), p_W.data()) && p_W.allFinite() &&
                        p_W.norm() < farthest_m;
  return is_place ? std::optional{p_W} : std::nullopt;
}

class GpsLocalizer final : public flyball::Localizer {
 public:
  explicit GpsLocalizer(GeodeticToEnu convert) : convert_{convert} {}

  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"position_gain", usual_gain, 0.001, 1.0, "share of a fix in the new position"}};
  }
  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    if (convert_ == nullptr) {
      return flyball::Error{flyball::ErrorCode::unavailable,
                            "localizer \"gps\" needs \"" + flyball::module_path("geodesy") +
                                "\", which cannot be loaded: is libmrpt-topography installed?"};
    }
    position_gain_ = chosen.number("position_gain");
    return flyball::Done{};
  }

  void start(const flyball::GeodeticOrigin& origin) override {
    origin_ = origin;
    fixed_ = std::nullopt;
    p_WB_ = v_WB_ = Vec3::Zero();
  }

  std::optional<flyball::PoseEstimate> estimate(const flyball::NavigationSample& sample,
                                                flyball::Work& work) override {
    work.add("samples", 1.0);
    carry_on(sample.stamp);
    if (const auto fix_W = to_world(convert_, sample, origin_)) {
      const bool is_carried = fixed_ && carried_to_ == sample.stamp;
      p_WB_ += (is_carried ? position_gain_ : 1.0) * (*fix_W - p_WB_);
      v_WB_ = sample.v_gps_W;
      fixed_ = carried_to_ = sample.stamp;
    }
    if (!fixed_) {
      return std::nullopt;
    }
    // Without a fix for too long nobody knows where the vehicle is: the estimate grows old.
    flyball::PoseEstimate estimate{carried_to_, flyball::Pose::Identity(), v_WB_};
    estimate.X_WB.translation() = p_WB_;
    estimate.X_WB.linear() = sample.q_WB_ahrs.normalized().toRotationMatrix();
    return estimate;
  }

 private:
  /// From the newest fix on, as long as a place may be carried on without one.
  void carry_on(flyball::MissionTime now) {
    if (fixed_) {
      const auto longest = flyball::from_seconds(flyball::longest_reckoning_s);
      const auto until = std::min(now, *fixed_ + longest);
      p_WB_ += flyball::to_seconds(until - carried_to_) * v_WB_;
      carried_to_ = until;
    }
  }

  GeodeticToEnu convert_;
  double position_gain_{usual_gain};
  flyball::GeodeticOrigin origin_{};
  std::optional<flyball::MissionTime> fixed_{};  ///< Stamp of the newest fix.
  flyball::MissionTime carried_to_{};            ///< Of `p_WB_`, from the first fix on.
  Vec3 p_WB_{Vec3::Zero()};
  Vec3 v_WB_{Vec3::Zero()};
};

}  // namespace

FLYBALL_PLUGIN(gps) {
  if (!std::filesystem::exists(flyball::module_path("geodesy"))) {
    return;  // Left out, as without MRPT.
  }
  registry.add<flyball::Localizer>(
      "gps", [] { return std::make_unique<GpsLocalizer>(load_conversion()); });
}
