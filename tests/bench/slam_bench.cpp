// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's SLAM experiment on rendered views, 320 x 240: a vehicle flies round a circle of 25 m
// radius, and the localizer must not lose its track. Prints Markdown.
//   slam_bench table [LOCALIZER]                        failed flights over speed and frame rate:
//                                                       track lost, or 5 % of the path off
//   slam_bench drift [LOCALIZER] [SPEED] [RATE] [PATH]  five flights: drift, work and time
// A vehicle with inertial sensors starts from rest and shakes as in hover; one without is at speed
// from the first frame.

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/imu.h"

#include "circle_flight.h"
#include "textured_camera.h"
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace {

using namespace flyball;

constexpr std::uint64_t runs = 5;
constexpr double quarter_lap_m = 39.27;
constexpr double widest_share = 0.05;  // Farther off than this share of the path is failed, too.

struct Outcome {
  bool lost{};
  double drift_share{};  ///< Position error at the end over the path.
  double worst_share{};  ///< Largest position error over the path.
  int frames{};
  int loops{};
  double inliers{};
  double host_ms{};  ///< Of one frame.
  Work work{};
};

struct Flight {
  std::string localizer;
  double speed_m_s{};
  double rate_hz{};
  double path_m{quarter_lap_m};
  std::uint64_t seed{1};
};

/// Inertial measurements up to a time.
class ImuFeed {
 public:
  ImuFeed(const kit::CircleRun& run, std::uint64_t seed) : run_{run}, imu_{{}, seed} {}
  void until(double t_s, Localizer& localizer) {
    for (; next_ * interval_s <= t_s + 1e-9; ++next_) {
      const double at_s = next_ * interval_s;
      localizer.add_imu_sample(imu_.sample(run_.at(at_s), MissionTime{from_seconds(at_s)}));
    }
  }

 private:
  static constexpr double interval_s = 0.005;
  kit::CircleRun run_;
  Imu imu_;
  int next_{};
};

std::unique_ptr<Localizer> make_localizer(const std::string& name) {
  Registry registry;
  register_kernels(registry);
  auto localizer = registry.make<Localizer>(name);
  if (!localizer || !localizer->inputs().images) {
    std::fprintf(stderr, "no localizer that sees is called %s\n", name.c_str());
    std::exit(2);
  }
  return localizer;
}

kit::TexturedCamera camera_for(std::uint64_t seed) {
  DepthCameraSpec spec;
  spec.width_px = 320;
  spec.height_px = 240;
  return {kit::circle_world(seed), spec, seed};
}

void judge(const Result<VisualFix>& fix, const Vec3& p_WB, double path_m, Outcome& outcome) {
  outcome.lost = !fix || !fix->tracked;
  if (!outcome.lost) {
    outcome.drift_share = (fix->X_WB.translation() - p_WB).norm() / path_m;
    outcome.worst_share = std::max(outcome.worst_share, outcome.drift_share);
    outcome.inliers += fix->inliers;
    outcome.loops = fix->loops_closed;
  }
}

Outcome fly(const Flight& flight) {
  const auto localizer = make_localizer(flight.localizer);
  const kit::TexturedCamera camera = camera_for(flight.seed);
  kit::CircleRun run{flight.speed_m_s, 0.0, false, 1e6};
  if (localizer->inputs().imu) {
    run = {flight.speed_m_s, 1.0, true, std::min(3.0, 0.5 * flight.speed_m_s)};
  }
  localizer->start({});
  localizer->set_initial_pose(run.at(0.0).X_WB);
  ImuFeed imu{run, flight.seed};
  Outcome outcome;
  std::chrono::duration<double> busy{};
  for (double t_s = 0.0; run.path_m(t_s) < flight.path_m && !outcome.lost;
       t_s = ++outcome.frames / flight.rate_hz) {
    const Pose X_WB = run.at(t_s).X_WB;
    VisualFrame frame =
        camera.capture(X_WB * kit::ahead_from_body(), MissionTime{from_seconds(t_s)},
                       static_cast<std::uint64_t>(outcome.frames));
    frame.X_BC = kit::ahead_from_body();
    if (localizer->inputs().imu) {
      imu.until(t_s, *localizer);
    }
    const auto begun = std::chrono::steady_clock::now();
    const auto fix = localizer->track_frame(frame, outcome.work);
    busy += std::chrono::steady_clock::now() - begun;
    judge(fix, X_WB.translation(), flight.path_m, outcome);
  }
  outcome.inliers /= outcome.frames;
  outcome.host_ms = 1e3 * busy.count() / outcome.frames;
  return outcome;
}

void print_table(const std::string& localizer) {
  std::printf("Flights of %d that failed with %s, quarter lap at 320 x 240:\n\n| m/s |", int{runs},
              localizer.c_str());
  const double rates_hz[] = {1.0, 2.0, 4.0, 8.0};
  for (const double rate_hz : rates_hz) {
    std::printf(" %g Hz |", rate_hz);
  }
  std::printf("\n|---|---|---|---|---|\n");
  for (const double speed_m_s : {2.0, 4.0, 8.0, 12.0}) {
    std::printf("| %g |", speed_m_s);
    for (const double rate_hz : rates_hz) {
      int failed = 0;
      for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        const Outcome outcome = fly({localizer, speed_m_s, rate_hz, quarter_lap_m, seed});
        failed += outcome.lost || outcome.worst_share > widest_share ? 1 : 0;
      }
      std::printf(" %d |", failed);
      std::fflush(stdout);
    }
    std::printf("\n");
  }
}

void print_drift(Flight flight) {
  std::printf("%s, %g m at %g m/s and %g Hz:\n\n", flight.localizer.c_str(), flight.path_m,
              flight.speed_m_s, flight.rate_hz);
  std::printf("| seed | lost | drift %% | worst %% | loops | inliers | host ms | work a frame |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (flight.seed = 1; flight.seed <= runs; ++flight.seed) {
    const Outcome outcome = fly(flight);
    std::printf("| %d | %s | %.2f | %.2f | %d | %.0f | %.1f |", static_cast<int>(flight.seed),
                outcome.lost ? "yes" : "no", 100.0 * outcome.drift_share,
                100.0 * outcome.worst_share, outcome.loops, outcome.inliers, outcome.host_ms);
    for (const WorkItem& item : outcome.work.items()) {
      std::printf(" %.*s %.0f", static_cast<int>(item.name.size()), item.name.data(),
                  item.count / outcome.frames);
    }
    std::printf(" |\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "table";
  const std::string localizer = argc > 2 ? argv[2] : "visual_slam";
  const auto number = [&](int place, double fallback) {
    return argc > place ? std::atof(argv[place]) : fallback;
  };
  if (what == "drift") {
    print_drift({localizer, number(3, 2.0), number(4, 10.0), number(5, quarter_lap_m)});
  } else {
    print_table(localizer);
  }
}
