// SPDX-License-Identifier: BSD-3-Clause
//
// Which kernel computes other bits on another processor? Each line is the name of a part and a hash
// over what it computes from one input that is the same everywhere: a part whose hash differs is
// named by `diff` of two runs. tests/README.md says how, for x86-64 and 64-bit Arm.

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/localizer.h"
#include "flyball/kernels/mapper.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/kernels/path_tracker.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/kernels/smoother.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/recorder.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/flight_controller.h"
#include "flyball/sim/vehicle.h"

#include "built_data.h"
#include "circle_flight.h"
#include "map_scenes.h"
#include "plan_scenes.h"
#include "textured_camera.h"
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

namespace flyball::bench {
namespace {

void print(const std::string& part, const TraceHash& hash) {
  std::printf("%-28s %s\n", part.c_str(), hash.hex().c_str());
}

void add(TraceHash& hash, const Vec3& v) {
  for (const double x : v) {
    hash.add(x);
  }
}

void c_library() {
  const std::vector<std::pair<const char*, std::function<double(double)>>> functions{
      {"sin", [](double x) { return std::sin(x); }},
      {"cos", [](double x) { return std::cos(x); }},
      {"tan", [](double x) { return std::tan(x); }},
      {"asin", [](double x) { return std::asin(x / 20.0); }},
      {"acos", [](double x) { return std::acos(x / 20.0); }},
      {"atan2", [](double x) { return std::atan2(x, 3.1); }},
      {"exp", [](double x) { return std::exp(x); }},
      {"exp2", [](double x) { return std::exp2(x); }},
      {"log", [](double x) { return std::log(x); }},
      {"pow", [](double x) { return std::pow(x, 1.7); }},
      {"sqrt", [](double x) { return std::sqrt(x); }},
      {"cbrt", [](double x) { return std::cbrt(x); }},
      {"hypot", [](double x) { return std::hypot(x, 1.7); }},
      {"erf", [](double x) { return std::erf(0.1 * x); }},
      {"tanh", [](double x) { return std::tanh(0.1 * x); }},
  };
  for (const auto& [name, function] : functions) {
    TraceHash hash;
    for (int i = 1; i <= 10000; ++i) {
      hash.add(function(0.0019 * i));
    }
    print(std::string{"C library, "} + name, hash);
  }
}

/// A product of this many rows and columns, and the solution of as many equations.
void eigen(int n) {
  RandomStream random{1, "eigen"};
  Eigen::MatrixXd a{n, n};
  for (int i = 0; i < n * n; ++i) {
    a(i / n, i % n) = random.uniform(-1.0, 1.0);
  }
  const auto hash_of = [](const Eigen::MatrixXd& m) {
    TraceHash hash;
    for (int i = 0; i < m.size(); ++i) {
      hash.add(m.data()[i]);
    }
    return hash;
  };
  const std::string size = std::to_string(n);
  print("Eigen, product of " + size, hash_of(a * a.transpose()));
  print("Eigen, QR of " + size, hash_of(a.householderQr().solve(Eigen::VectorXd::Ones(n))));
}

Airframe airframe() {
  const auto loaded = load_airframe(kit::built_data() + "/airframes/matrice_100.toml");
  if (!loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
    std::exit(1);
  }
  return *loaded;
}

constexpr double step_s = 0.004;

/// Unequal rotors and a side wind, from rest, without a controller.
void vehicle(const char* name, const std::optional<GimbalSpec>& gimbal) {
  Vehicle flying{airframe(), 0.5, {{0.0, 0.0, 20.0}, 0.3, 0.0}, gimbal};
  TraceHash hash;
  for (int i = 0; i < 250; ++i) {
    flying.step(step_s, {63.0, 61.0, 60.0, 62.5}, {1.0, -0.4, 0.1});
    add(hash, flying.state().X_WB.translation());
    add(hash, flying.state().X_WB.linear().col(0));
  }
  print(name, hash);
}

/// The controller on states that no vehicle has computed.
void flight_controller() {
  FlightController controller{airframe(), 0.0};
  VehicleState state;
  state.X_WB.translation() = Vec3{0.0, 0.0, 5.0};
  controller.hold(state);
  TraceHash hash;
  for (int i = 1; i <= 500; ++i) {
    const double tilt = 0.2 * (i % 50) / 50.0;
    state.X_WB.linear() = Eigen::Quaterniond{1.0, tilt, -0.5 * tilt, 0.1}.normalized().matrix();
    state.v_WB = Vec3{0.01 * i, 0.3, -0.02 * (i % 7)};
    state.w_WB_B = Vec3{0.1, -0.05 * (i % 3), 0.02};
    const MissionTime now{from_seconds(step_s * i)};
    for (const double rev_s : controller.update(state, 3.0, now, step_s)) {
      hash.add(rev_s);
    }
  }
  print("flight controller", hash);
}

void depth_camera() {
  DepthCameraSpec spec;
  spec.rgbd_noise = true;
  const DepthCamera camera{kit::circle_world(1), spec, 1};
  TraceHash hash;
  for (std::uint64_t i = 0; i < 4; ++i) {
    const double path_m = 2.0 * static_cast<double>(i);
    for (const float depth : camera.capture(kit::circle_pose(path_m), {}, i).depth_m) {
      hash.add(static_cast<double>(depth));
    }
  }
  print("depth camera (Embree)", hash);
}

constexpr int flight_stride = 10;
constexpr ImageSize image{160, 120};

void points(const Registry& registry, const std::vector<Frame>& frames) {
  for (const std::string& name : registry.names<PointCloudBuilder>()) {
    const auto builder = registry.make<PointCloudBuilder>(name);
    TraceHash hash;
    for (const Frame& frame : frames) {
      Work work;
      const DepthFrame depths{
          {}, 0, image.width_px * image.height_px, frame.pixels.pixels->image, {}};
      const auto built = builder->build(depths, scene_range_m, work);
      for (const auto& p_C : built.cloud_C.value().hits_C) {
        add(hash, p_C.cast<double>());
      }
    }
    print("points, " + name, hash);
  }
}

void maps(const Registry& registry, const std::vector<Frame>& frames) {
  for (const std::string& name : registry.names<Mapper>()) {
    const auto mapper = registry.make<Mapper>(name);
    const auto parameters = Parameters::resolve(name, mapper->parameters(), {});
    if (!mapper->configure(std::get<Parameters>(parameters), no_models)) {
      continue;
    }
    TraceHash hash;
    for (const Frame& frame : frames) {
      const auto work = mapper->prepare_frame(frame.pixels, frame.X_WC, {0.15, 7.0});
      mapper->commit();
      hash.add(work ? work->count("updates") : -1.0);
    }
    for (const OccupiedCell& cell : mapper->occupied()) {
      add(hash, cell.centre_W);
    }
    print("map, " + name, hash);
  }
}

void planners(const Registry& registry) {
  for (const std::string& name : registry.names<PathPlanner>()) {
    TraceHash hash;
    for (const std::uint64_t seed : {1, 2, 3}) {
      const kit::Scene scene = kit::random_world(seed);
      for (const Vec3& p_W :
           registry.make<PathPlanner>(name)->plan(scene.request, scene.map).waypoints_W) {
        add(hash, p_W);
      }
    }
    print("planner, " + name, hash);
  }
}

SmoothRequest slalom() {
  SmoothRequest request;
  request.waypoints_W = {{0, 0, 2}, {4, 1.3, 2.2}, {9, -0.7, 2.1}, {13, 2.9, 1.9}, {20, 0.3, 2}};
  request.start_velocity_W = {1.0, 0.2, 0.0};
  request.max_speed_m_s = 6.0;
  request.max_acceleration_m_s2 = 4.0;
  request.body = kit::slow_body();
  return request;
}

void smoothers_and_trackers(const Registry& registry) {
  const kit::GridMap open{{{-2, -8, 0}, {24, 8, 4.5}}, 0.15};
  for (const std::string& name : registry.names<Smoother>()) {
    const auto smooth = registry.make<Smoother>(name)->smooth(slalom(), open);
    TraceHash hash;
    if (smooth) {
      for (const PolynomialPiece& piece : smooth->trajectory.pieces) {
        hash.add(piece.duration_s);
        for (int i = 0; i < piece.c.size(); ++i) {
          hash.add(piece.c.data()[i]);
        }
      }
    }
    print("smoother, " + name, hash);
  }
  const Path path = Path::polyline(slalom().waypoints_W);
  for (const std::string& name : registry.names<PathTracker>()) {
    TraceHash hash;
    const auto tracker = registry.make<PathTracker>(name);
    for (int i = 0; i < 100; ++i) {
      PoseEstimate where;
      where.X_WB.translation() = Vec3{0.2 * i, 0.3, 2.0};
      const Setpoint set = tracker->track(path, {0.19 * i, 3.0, 0.5, 0.1}, where, {});
      add(hash, set.v_WB);
      add(hash, set.a_WB);
    }
    print("path tracker, " + name, hash);
  }
}

void localizers(const Registry& registry) {
  DepthCameraSpec spec;
  spec.width_px = 224;
  spec.height_px = 168;
  const kit::TexturedCamera camera{kit::circle_world(1), spec, 1};
  for (const std::string& name : registry.names<Localizer>()) {
    const auto localizer = registry.make<Localizer>(name);
    if (!localizer->inputs().images) {
      continue;
    }
    localizer->start({});
    localizer->set_initial_pose(kit::circle_pose(0.0) * kit::ahead_from_body().inverse());
    TraceHash hash;
    for (std::uint64_t i = 0; i < 6; ++i) {
      Work work;
      const double path_m = 0.2 * static_cast<double>(i);
      const MissionTime now{from_seconds(0.1 * static_cast<double>(i))};
      const auto fix =
          localizer->track_frame(camera.capture(kit::circle_pose(path_m), now, i), work);
      add(hash, fix ? fix->X_WB.translation() : Vec3{-1, -1, -1});
    }
    print("localizer, " + name, hash);
  }
}

void all_parts() {
  Registry registry;
  register_kernels(registry);
  c_library();
  eigen(8);
  eigen(32);
  vehicle("vehicle", std::nullopt);
  vehicle("vehicle with a gimbal (Simbody)", GimbalSpec{});
  flight_controller();
  depth_camera();
  const auto frames = frames_of(Scene::indoor, image, flight_stride);
  points(registry, frames);
  maps(registry, frames);
  planners(registry);
  smoothers_and_trackers(registry);
  localizers(registry);
}

}  // namespace
}  // namespace flyball::bench

int main() {
  flyball::bench::all_parts();
  return 0;
}
