// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/depth_camera.h"

#include "flyball/runtime/random.h"

#include "mover_view.h"
#include "pinhole.h"
#include "solid_rays.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double min_depth_m = 0.05;  // Noise does not push a surface into the lens.

// Standard deviation of MAVBench's RGB-D model (its code).
double rgbd_sigma_m(double d) {
  return d < 6.0 ? std::max(0.0, 0.0035 * d - 0.0023) : 0.0657 * d - 0.4193;
}

// Sum of eight 16-bit uniforms, scaled to variance 1: quantiles within 2 % of the normal
// distribution's up to 2.3 sigma, 4 % short at 3 sigma, never beyond 4.9. Box-Muller costs more,
// and its logarithm and cosine differ between processors in the last bit; this does not.
double cheap_normal(RandomStream& random) {
  constexpr std::uint64_t every_other = 0x0000ffff0000ffff;
  std::uint64_t pairs = 0;  // sums of four, side by side
  for (int word = 0; word < 2; ++word) {
    const std::uint64_t bits = random.next();
    pairs += (bits & every_other) + (bits >> 16U & every_other);
  }
  const std::uint64_t sum = (pairs & 0xffffffffU) + (pairs >> 32U);
  constexpr double mean = 8.0 * 0.5 * 65535.0;
  constexpr double sigma = 53509.9;  // sqrt(8 (65536^2 - 1) / 12)
  return (static_cast<double>(sum) - mean) / sigma;
}

/// The orientation of the ring's camera `i` in the first one's frame: turned around the upright.
Eigen::Matrix3d turned(const DepthCameraSpec& spec, int i) {
  constexpr double full_turn_rad = 6.283185307179586;
  const Vec3 up_C{0.0, -std::cos(spec.pitch_down_rad), -std::sin(spec.pitch_down_rad)};
  return Eigen::AngleAxisd{full_turn_rad * i / spec.count, up_C}.toRotationMatrix();
}

}  // namespace

Intrinsics DepthCameraSpec::intrinsics() const {
  return pinhole(width_px, height_px, horizontal_field_rad);
}

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
  RandomStream random{seed, "depth_noise", sequence};
  for (float& depth : depth_m) {
    if (depth == infinity) {
      continue;
    }
    const double d = static_cast<double>(depth);
    const double rgbd = spec.rgbd_noise ? rgbd_sigma_m(d) : 0.0;
    // Without other noise the root of its square is the number itself, to the bit.
    const double sigma_m = spec.extra_noise_m > 0.0
                               ? std::sqrt(rgbd * rgbd + spec.extra_noise_m * spec.extra_noise_m)
                               : rgbd;
    const double noisy = std::max(d + sigma_m * cheap_normal(random), min_depth_m);
    depth = noisy <= spec.max_range_m ? static_cast<float>(noisy) : infinity;
  }
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
