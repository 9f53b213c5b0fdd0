// SPDX-License-Identifier: BSD-3-Clause
//
// The reference's own position, velocity and acceleration go to the autopilot, whose loops supply
// the proportional and derivative action; a position error adds a little velocity. That takes
// nobody to an estimate that has drifted from the autopilot's own: set-points are carried over for
// that (flight/odometry_frame.h), and the caller reports no error then.

#include "flyball/kernels/path_tracker.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cmath>

namespace {

using flyball::Vec3;

// Chosen by hand on the shipped airframes.
struct Settings {
  double position_gain_1_s{0.8};
  double max_correction_m_s{0.5};
  double max_centripetal_m_s2{4.0};  ///< Half the tilt that braking takes: more is a kink.
};

constexpr double look_m = 0.1;  // Two samples of a path; their tangents differ measurably.

/// Towards the centre of the curve; zero where the path is straight.
Vec3 normal_at(const flyball::Path& path, const flyball::Path::Sample& here) {
  const Vec3 change = path.at(here.s_m + look_m).tangent_W - path.at(here.s_m - look_m).tangent_W;
  const Vec3 sideways = change - change.dot(here.tangent_W) * here.tangent_W;
  return sideways.norm() > 1e-6 ? Vec3{sideways.normalized()} : Vec3::Zero();
}

class FeedforwardPd final : public flyball::PathTracker {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    const Settings usual;
    return {{"position_gain_1_s", usual.position_gain_1_s, 0.0, 10.0,
             "speed that is added for each metre off the path"},
            {"max_correction_m_s", usual.max_correction_m_s, 0.0, 10.0,
             "at most so much: a jump of the estimate must not become a jump of the vehicle"},
            {"max_centripetal_m_s2", usual.max_centripetal_m_s2, 0.0, 20.0,
             "most acceleration that is fed forward in a bend"}};
  }
  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    settings_ = {chosen.number("position_gain_1_s"), chosen.number("max_correction_m_s"),
                 chosen.number("max_centripetal_m_s2")};
    return flyball::Done{};
  }

  flyball::Setpoint track(const flyball::Path& path,
                          const flyball::PathReference& reference,
                          const flyball::PoseEstimate& where,
                          flyball::MissionTime now) override {
    flyball::Setpoint setpoint;
    setpoint.stamp = now;
    setpoint.yaw_rad = reference.yaw_rad;
    if (path.empty()) {  // Nothing to follow: stay.
      setpoint.p_WB = where.X_WB.translation();
      return setpoint;
    }
    const auto here = path.at(reference.s_m);
    const double speed_m_s = reference.speed_m_s;
    setpoint.p_WB = here.p_W;
    setpoint.v_WB = speed_m_s * here.tangent_W + correction(here.p_W - where.X_WB.translation());
    setpoint.a_WB = reference.acceleration_m_s2 * here.tangent_W;
    if (std::isfinite(here.curvature_1_m)) {  // A corner is passed at a crawl: nothing to feed.
      const double towards_centre = speed_m_s * speed_m_s * here.curvature_1_m;
      setpoint.a_WB +=
          std::min(towards_centre, settings_.max_centripetal_m_s2) * normal_at(path, here);
    }
    return setpoint;
  }

 private:
  [[nodiscard]] Vec3 correction(const Vec3& error_m) const {
    const Vec3 wished_m_s = settings_.position_gain_1_s * error_m;
    const double size_m_s = wished_m_s.norm();
    const double most_m_s = settings_.max_correction_m_s;
    return size_m_s > most_m_s ? Vec3{wished_m_s * (most_m_s / size_m_s)} : wished_m_s;
  }

  Settings settings_{};
};

}  // namespace

FLYBALL_PLUGIN(feedforward_pd) {
  registry.add<flyball::PathTracker>("feedforward_pd",
                                     [] { return std::make_unique<FeedforwardPd>(); });
}
