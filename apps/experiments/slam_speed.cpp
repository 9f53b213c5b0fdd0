// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's SLAM micro-benchmark: a vehicle that flies round a circle of 25 m radius must not lose
// its track in more than a fifth of its flights, and may be the faster the more frames it looks at.

#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/flight/perception/view.h"
#include "flyball/kernels/localizer.h"
#include "flyball/scenario/files.h"
#include "flyball/sim/colour_camera.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/rotor_power.h"

#include "experiments/framework/circle.h"
#include "experiments/framework/papers.h"
#include "scenario/kernel_choice.h"
#include "simulation/seeing_setup.h"
#include <array>
#include <cmath>
#include <string>

namespace flyball::experiments {
namespace {

constexpr int runs = 5;                // So that a fifth is one flight.
constexpr int most_failures = 1;       // The paper: at most 20 %.
constexpr double flown_m = 39.27;      // A quarter of the circle: what a host can render.
constexpr double widest_share = 0.05;  // Farther off than this share of the path is failed, too.
constexpr std::array<double, 4> rates_hz{2.0, 4.0, 6.0, 10.0};
// From above: what is fast takes few frames.
constexpr std::array<double, 9> speeds_m_s{20.0, 16.0, 12.0, 10.0, 8.0, 6.0, 4.0, 2.0, 1.0};

/// What a flight sees.
struct Picture {
  int width_px{};
  int height_px{};
  [[nodiscard]] std::string text() const {
    return std::to_string(width_px) + " x " + std::to_string(height_px) + " pixels";
  }
};
constexpr Picture usual{256, 144};  // As all flights.
constexpr Picture finer{512, 288};

/// One world with its cameras.
class Circle {
 public:
  static Result<std::unique_ptr<Circle>> make(std::uint64_t seed, const Picture& picture) {
    auto circle = std::unique_ptr<Circle>(new Circle{seed, picture});
    auto colour = ColourCamera::make(circle->world_, colour_beside(circle->spec_));
    if (!colour) {
      return colour.error();
    }
    circle->colour_ = std::move(*colour);
    return circle;
  }

  /// Whether the localizer keeps its track at this speed, from the first frame on.
  [[nodiscard]] Result<bool> is_tracked(double speed_m_s, double rate_hz) const {
    KernelSettings kernels;
    kernels.localizer = "visual_slam";
    const auto localizer = make_kernel<Localizer>(Plugins{}, kernels);
    if (!localizer) {
      return localizer.error();
    }
    (*localizer)->start({});
    (*localizer)->set_initial_pose(body_at(0.0));
    int frames = 0;
    for (double path_m = 0.0; path_m < flown_m; path_m = speed_m_s * ++frames / rate_hz) {
      Work work;
      const auto fix = (*localizer)->track_frame(frame_at(path_m, frames / rate_hz, frames), work);
      if (!fix) {
        return fix.error();
      }
      const double off_m = (fix->X_WB.translation() - body_at(path_m).translation()).norm();
      if (!fix->tracked || off_m > widest_share * flown_m) {
        return false;
      }
    }
    return true;
  }

 private:
  Circle(std::uint64_t seed, const Picture& picture)
      : spec_{picture.width_px, picture.height_px},
        world_{circle_world(seed)},
        depth_{world_, spec_, seed} {}

  [[nodiscard]] Pose body_at(double path_m) const {
    return circle_pose(path_m) * camera_pose(Pose::Identity(), spec_).inverse();
  }
  [[nodiscard]] VisualFrame frame_at(double path_m, double time_s, int number) const {
    const Pose X_WC = circle_pose(path_m);
    const MissionTime now{from_seconds(time_s)};
    const auto sequence = static_cast<std::uint64_t>(number);
    View view;
    view.X_BC = body_at(path_m).inverse() * X_WC;
    view.depth = depth_.frame(X_WC, now, sequence);
    view.colour = colour_->frame({X_WC, view.X_BC}, now, sequence);
    return visual_frame(view);
  }

  DepthCameraSpec spec_;
  World world_;
  DepthCamera depth_;
  std::unique_ptr<ColourCamera> colour_{};
};

using Circles = std::vector<std::unique_ptr<Circle>>;

Result<Circles> worlds(const Picture& picture) {
  Circles all;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    auto circle = Circle::make(seed, picture);
    if (!circle) {
      return circle.error();
    }
    all.push_back(std::move(*circle));
  }
  return all;
}

/// Whether at most a fifth of the flights lose their track.
Result<bool> is_flown(const Circles& circles, double speed_m_s, double rate_hz) {
  int failed = 0;
  for (const auto& circle : circles) {
    const auto tracked = circle->is_tracked(speed_m_s, rate_hz);
    if (!tracked) {
      return tracked.error();
    }
    failed += *tracked ? 0 : 1;
    if (failed > most_failures) {
      return false;
    }
  }
  return true;
}

/// Empty: not even the lowest of the speeds is flown.
Result<std::optional<double>> highest_speed(const Circles& circles, double rate_hz) {
  for (const double speed_m_s : speeds_m_s) {
    const auto flown = is_flown(circles, speed_m_s, rate_hz);
    if (!flown) {
      return flown.error();
    }
    if (*flown) {
      return std::optional{speed_m_s};
    }
  }
  return std::optional<double>{};
}

/// Energy of one lap by eq. 1, at constant speed.
double lap_kj(const Airframe& airframe, double speed_m_s) {
  RegressionPower power{airframe};
  VehicleState state;
  state.rotor_rev_s.fill(1.0);
  state.v_WB = Vec3{speed_m_s, 0.0, 0.0};
  state.a_WB = Vec3{0.0, speed_m_s * speed_m_s / circle_radius_m, 0.0};
  double power_w = 0.0;
  for (int i = 0; i < 100; ++i) {  // Until its low-pass has settled.
    power_w = power.update(state, 0.0, Vec3::Zero(), 0.1);
  }
  return 1e-3 * power_w * full_turn_rad * circle_radius_m / speed_m_s;
}

/// Of one size of pictures, by frame rates.
struct Curves {
  std::vector<std::optional<double>> speeds_m_s{};
  std::vector<std::optional<double>> laps_kj{};
  /// Of a lap at the lowest rate over that at the highest.
  [[nodiscard]] Measured ratio() const {
    return laps_kj.front() && laps_kj.back() ? computed(*laps_kj.front() / *laps_kj.back())
                                             : Measured{};
  }
};

Result<Curves> fly(const Picture& picture, const Airframe& airframe) {
  const auto circles = worlds(picture);
  if (!circles) {
    return circles.error();
  }
  Curves curves;
  for (const double rate_hz : rates_hz) {
    const auto speed = highest_speed(*circles, rate_hz);
    if (!speed) {
      return speed.error();
    }
    const auto& found = *speed;
    curves.speeds_m_s.push_back(found);
    curves.laps_kj.push_back(found ? std::optional{lap_kj(airframe, *found)} : std::nullopt);
  }
  return curves;
}

LinePlot plot_of(const char* title) {
  LinePlot plot{title, "frames a second", {}, {}};
  for (const double rate_hz : rates_hz) {
    plot.places.push_back(std::to_string(static_cast<int>(rate_hz)));
  }
  return plot;
}

void add_line(const Picture& picture,
              const std::vector<std::optional<double>>& values,
              LinePlot& plot) {
  auto& line = plot.lines.emplace_back();
  line.name = picture.text();
  for (const auto& value : values) {
    line.values.push_back(value ? computed(*value).value : std::nullopt);
  }
}

Result<Findings> evaluate(const Evidence& /*evidence*/) {
  const auto file = find_shipped("airframes", "matrice_100");
  if (!file) {
    return file.error();
  }
  const auto airframe = load_airframe(*file);
  if (!airframe) {
    return airframe.error();
  }
  LinePlot speeds = plot_of("highest speed with at most 20 % failures, m/s");
  LinePlot energies = plot_of("energy of a lap at that speed, kJ");
  Claim claim{"energy of a lap at 2 frames a second over that at 10"};
  claim.paper =
      PaperValue{4.0, "SLAM micro-benchmark: about 4 times less for 5 times the frame rate"};
  claim.neutral = 1.0;
  for (const Picture& picture : {usual, finer}) {
    const auto curves = fly(picture, *airframe);
    if (!curves) {
      return curves.error();
    }
    add_line(picture, curves->speeds_m_s, speeds);
    add_line(picture, curves->laps_kj, energies);
    if (picture.width_px == usual.width_px) {
      claim.ours = curves->ratio();
    } else {
      claim.causes.push_back({"with pictures of " + picture.text(), curves->ratio()});
    }
  }
  const char* caption =
      "Computed on rendered frames, five worlds, a quarter lap each; speeds of 1, 2, 4 ... 12, 16, "
      "20 m/s. Where a line has no point, not even 1 m/s was flown.";
  return Findings{{claim}, {{"speed", caption, speeds}, {"energy", caption, energies}}, {}};
}

}  // namespace

Experiment slam_speed() {
  return {
      "How fast may a vehicle fly by visual SLAM?",
      std::string{mavbench} + ", SLAM micro-benchmark",
      "Circle of 25 m radius between trees and houses, RGB-D frames rendered from the true poses, "
      "localizer visual_slam. A flight fails when the track is lost or 5 % of "
      "the path off. Energy is eq. 1 at the highest speed with at most 20 % failures.",
      {},
      {},
      evaluate};
}

}  // namespace flyball::experiments
