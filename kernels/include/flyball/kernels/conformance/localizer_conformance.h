// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of localizer.h as checks, on a motion that is known: the vehicle stands, then
/// speeds up along a painted room, and every sensor that a localizer may ask for says so without
/// noise.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/conformance/painted_scan.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

class LocalizerConformance : public KernelConformance<Localizer> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({}, [this] {
      check_start();
      check_motion();
      check_broken_fix();
      check_frames();
      check_missions();
    });
  }

 private:
  static constexpr double start_x_m = -0.52;  // Where the camera of `room_scan` begins.
  static constexpr double stand_s = 0.5;
  static constexpr double gain_m_s2 = 0.5;
  static constexpr double end_s = 2.5;
  static constexpr double most_error_m = 0.3;
  static constexpr int tick_ms = 5;  // Of the IMU; other sensors have multiples of it.

  static double moving_s(double t_s) { return std::max(0.0, t_s - stand_s); }
  static TruePose truth_at(int at_ms) {
    const double t_s = 1e-3 * at_ms;
    TruePose truth;
    truth.stamp = MissionTime{std::chrono::milliseconds{at_ms}};
    truth.X_WB.translation() =
        Vec3{start_x_m + 0.5 * gain_m_s2 * moving_s(t_s) * moving_s(t_s), 0.0, 1.41};
    truth.v_WB = Vec3{gain_m_s2 * moving_s(t_s), 0.0, 0.0};
    return truth;
  }

  /// Exact to some millimetres near the origin (radii of curvature of WGS-84).
  static NavigationSample sample_at(int at_ms) {
    const TruePose truth = truth_at(at_ms);
    const GeodeticOrigin origin;
    constexpr double e2 = 6.69437999014e-3;
    const double s = std::sin(origin.latitude_rad);
    const double w2 = 1.0 - e2 * s * s;
    const double meridian_m = 6378137.0 * (1.0 - e2) / std::pow(w2, 1.5) + origin.height_m;
    const double normal_m = 6378137.0 / std::sqrt(w2) + origin.height_m;
    const Vec3 p_W = truth.X_WB.translation();
    NavigationSample sample;
    sample.stamp = truth.stamp;
    sample.has_fix = at_ms % 100 == 0;
    sample.latitude_rad = origin.latitude_rad + p_W.y() / meridian_m;
    sample.longitude_rad =
        origin.longitude_rad + p_W.x() / (normal_m * std::cos(origin.latitude_rad));
    sample.height_m = origin.height_m + p_W.z();
    sample.v_gps_W = truth.v_WB;
    sample.pressure_pa = standard_pressure_pa(origin.height_m + p_W.z());
    return sample;
  }
  static ImuSample imu_sample_at(int at_ms) {
    ImuSample sample;
    sample.stamp = MissionTime{std::chrono::milliseconds{at_ms}};
    sample.f_B = Vec3{1e-3 * at_ms > stand_s ? gain_m_s2 : 0.0, 0.0, 9.80665};
    return sample;
  }

  /// 0..1, the same for all points of one cube of a lattice.
  static double block_value(const Vec3& p_W, double side_m) {
    auto h = static_cast<std::uint64_t>(side_m * 1024.0);
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell = static_cast<std::int64_t>(std::floor(p_W[axis] / side_m + 0.37));
      h = (h ^ static_cast<std::uint64_t>(cell)) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 29U;
    }
    return static_cast<double>((h * 0xbf58476d1ce4e5b9ULL) >> 40U) / 16777216.0;
  }
  static VisualFrame frame_at(int at_ms) {
    const double ahead_m = truth_at(at_ms).X_WB.translation().x() - start_x_m;
    const RoomScan scan = room_scan(0, 0.0, 224, ahead_m);
    VisualFrame frame;
    frame.captured = MissionTime{std::chrono::milliseconds{at_ms}};
    const Intrinsics& lens = scan.image.camera;
    frame.camera = {lens.width_px,
                    lens.height_px,
                    lens.focal_px,
                    lens.focal_px,
                    lens.centre_x_px,
                    lens.centre_y_px,
                    {},
                    DistortionModel::radial_tangential};
    frame.X_BC.linear() = scan.X_WC.linear();
    frame.depth_m = scan.image.depth_m;
    for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
      const int u = static_cast<int>(i) % lens.width_px;
      const int v = static_cast<int>(i) / lens.width_px;
      const auto depth_m = static_cast<double>(frame.depth_m[i]);
      const Vec3 p_W = scan.X_WC * Vec3{depth_m * (u - lens.centre_x_px) / lens.focal_px,
                                        depth_m * (v - lens.centre_y_px) / lens.focal_px, depth_m};
      const double grey = block_value(p_W, 0.19) + block_value(p_W, 0.47);
      frame.grey.push_back(static_cast<std::uint8_t>(20.0 + 105.0 * grey));
    }
    return frame;
  }

  struct Flight {
    std::vector<double> trace{};
    double worst_m{};
    double worst_rad{};
    bool answered{true};
    bool stamps_right{true};
    bool poses_sound{true};
    bool tracked{true};
    Work work{};
    int samples{};
  };

  void note(const std::optional<PoseEstimate>& found, int at_ms, Flight& flight) const {
    flight.answered = flight.answered && found;
    const TruePose truth = truth_at(at_ms);
    const PoseEstimate estimate = found.value_or(PoseEstimate{truth.stamp});
    const Vec3 p_W = estimate.X_WB.translation();
    const Eigen::Matrix3d R = estimate.X_WB.linear();
    flight.stamps_right = flight.stamps_right && estimate.stamp == truth.stamp;
    flight.poses_sound = flight.poses_sound && p_W.allFinite() && estimate.v_WB.allFinite() &&
                         (R * R.transpose()).isIdentity(1e-6) && R.determinant() > 0.0;
    flight.worst_m = std::max(flight.worst_m, (p_W - truth.X_WB.translation()).norm());
    flight.worst_rad =
        std::max(flight.worst_rad, Eigen::AngleAxisd{truth.X_WB.linear().transpose() * R}.angle());
    flight.trace.insert(flight.trace.end(), {p_W.x(), p_W.y(), p_W.z(), estimate.v_WB.x()});
  }

  void look(Localizer& localizer, int at_ms, Flight& flight) {
    const auto fix = localizer.track_frame(frame_at(at_ms), flight.work);
    require(fix.ok(), fix ? "" : "refuses an ordinary frame: " + fix.error().message);
    if (fix) {
      flight.tracked = flight.tracked && fix->tracked;
      localizer.correct(*fix);
    }
  }

  Flight fly(Localizer& localizer, int until_ms = static_cast<int>(1000.0 * end_s)) {
    const LocalizerInputs inputs = localizer.inputs();
    localizer.start(GeodeticOrigin{});
    localizer.set_initial_pose(truth_at(0).X_WB);
    Flight flight;
    for (int at_ms = 0; at_ms <= until_ms; at_ms += tick_ms) {
      if (inputs.imu) {
        localizer.add_imu_sample(imu_sample_at(at_ms));
      }
      if (inputs.images && at_ms % 100 == 0) {
        look(localizer, at_ms, flight);
      }
      if (at_ms % 20 == 0) {
        if (inputs.truth) {
          localizer.set_true_pose(truth_at(at_ms));
        }
        ++flight.samples;
        note(localizer.estimate(sample_at(at_ms), flight.work), at_ms, flight);
      }
    }
    return flight;
  }

  void check_start() {
    const auto localizer = made();
    localizer->start(GeodeticOrigin{});
    NavigationSample empty = sample_at(100);
    empty.has_fix = false;
    Work work;
    require(localizer->inputs().images || !localizer->estimate(empty, work),
            "estimates a pose before anything told it one");
  }

  void check_motion() {
    const auto localizer = made();
    const Flight flight = fly(*localizer);
    require(flight.answered, "estimates no pose although it was told where it is");
    require(flight.stamps_right, "does not stamp its estimate with the sample's time");
    require(flight.poses_sound, "estimates a pose that is none");
    require(flight.worst_m < most_error_m, "is off by more than .3 m after two seconds");
    require(flight.worst_rad < 0.1, "is wrong about the attitude");
    require(flight.tracked, "loses its track in a room full of corners");
    require(is_countable(flight.work) && flight.work.count("samples") == flight.samples,
            "does not count its samples");
    require_work(flight.work, fly(*made(), 1000).work);
  }

  void check_broken_fix() {
    const auto localizer = made();
    const Flight before = fly(*localizer, 1000);
    NavigationSample broken = sample_at(1100);
    broken.latitude_rad = std::numeric_limits<double>::quiet_NaN();
    broken.has_fix = true;
    Work work;
    Flight after;
    for (const NavigationSample& sample : {broken, sample_at(1200)}) {
      if (localizer->inputs().truth) {
        localizer->set_true_pose(truth_at(1200));
      }
      note(localizer->estimate(sample, work), 1200, after);
    }
    require(!before.poses_sound || after.poses_sound, "is poisoned by a fix that is not finite");
  }

  void check_frames() {
    const auto localizer = made();
    localizer->start(GeodeticOrigin{});
    localizer->set_initial_pose(truth_at(0).X_WB);
    Work work;
    if (!localizer->inputs().images) {
      const auto fix = localizer->track_frame(frame_at(0), work);
      require(!fix && fix.error().code == ErrorCode::unavailable,
              "answers a frame although it looks at no images");
      return;
    }
    VisualFrame broken = frame_at(0);
    broken.grey.resize(100);
    const auto fix = localizer->track_frame(broken, work);
    require(!fix && fix.error().code == ErrorCode::invalid_input && !fix.error().message.empty(),
            "accepts a frame that is not of its camera's size");
  }

  void check_missions() {
    const auto used = made();
    const Flight first = fly(*used);
    const Flight again = fly(*used);
    const Flight fresh = fly(*made());
    require(first.trace == again.trace, "does not forget the last mission at its start");
    require(first.trace == fresh.trace, "estimates differently in a second mission");
  }
};

}  // namespace flyball
