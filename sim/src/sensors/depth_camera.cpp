// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/depth_camera.h"

#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/random.h"

#include "sensors/ray_loops.h"
#include "sensors/solid_rays.h"
#include "world/mover_view.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double min_depth_m = 0.05;  // Noise does not push a surface into the lens.

/// The orientation of the ring's camera `i` in the first one's frame: turned around the upright.
Eigen::Matrix3d turned(const DepthCameraSpec& spec, int i) {
  constexpr double full_turn_rad = 6.283185307179586;
  const Vec3 up_C{0.0, -std::cos(spec.pitch_down_rad), -std::sin(spec.pitch_down_rad)};
  return Eigen::AngleAxisd{full_turn_rad * i / spec.count, up_C}.toRotationMatrix();
}

}  // namespace

struct DepthCamera::Scene {
  Scene(const World& world, const DepthCameraSpec& camera_spec, std::uint64_t noise_seed)
      : spec{camera_spec},
        camera{camera_spec.intrinsics()},
        seed{noise_seed},
        movers{world.movers},
        solids{world} {}

  void add_noise(std::uint64_t sequence, std::vector<float>& depth_m) const;

  DepthCameraSpec spec;
  Intrinsics camera;
  std::uint64_t seed;
  std::vector<Mover> movers;
  SolidRays solids;
};

void DepthCamera::Scene::add_noise(std::uint64_t sequence, std::vector<float>& depth_m) const {
  if (!spec.rgbd_noise && spec.extra_noise_m <= 0.0) {
    return;
  }
  const RandomStream random{seed, "depth_noise", sequence};
  const DepthNoise noise{spec.rgbd_noise, spec.extra_noise_m, min_depth_m, spec.max_range_m};
  supported_ray_loops().back()->add_noise(noise, random.state(), depth_m.size(), depth_m.data());
}

DepthCamera::DepthCamera(const World& world, const DepthCameraSpec& spec, std::uint64_t seed)
    : scene_{std::make_unique<Scene>(world, spec, seed)} {}

DepthCamera::~DepthCamera() = default;

const DepthCameraSpec& DepthCamera::spec() const {
  return scene_->spec;
}

DepthImage DepthCamera::capture(const Pose& X_WC, MissionTime now, std::uint64_t sequence) const {
  DepthImage image;
  image.captured = now;
  image.sequence = sequence;
  image.camera = scene_->camera;
  image.max_range_m = scene_->spec.max_range_m;
  image.depth_m.resize(static_cast<std::size_t>(image.camera.width_px) *
                       static_cast<std::size_t>(image.camera.height_px));
  scene_->solids.look(image.camera, X_WC, image.max_range_m, image.depth_m.data());
  draw(scene_->movers, X_WC, image);
  scene_->add_noise(sequence, image.depth_m);
  return image;
}

DepthFrame DepthCamera::frame(const Pose& X_WC, MissionTime now, std::uint64_t sequence) const {
  const Intrinsics& camera = scene_->camera;
  const auto count = static_cast<std::uint64_t>(scene_->spec.count);
  const auto deferred = [this, now](const Pose& from, std::uint64_t number) {
    return Deferred<DepthImage>{[this, from, now, number] { return capture(from, now, number); }};
  };
  DepthFrame frame{now, sequence, camera.width_px * camera.height_px,
                   deferred(X_WC, count * sequence)};
  for (std::uint64_t i = 1; i < count; ++i) {
    const Eigen::Matrix3d R_CS = turned(scene_->spec, static_cast<int>(i));
    Pose X_WS = X_WC;
    X_WS.linear() = X_WC.linear() * R_CS;
    frame.sides.push_back({R_CS, deferred(X_WS, count * sequence + i)});
  }
  return frame;
}

}  // namespace flyball
