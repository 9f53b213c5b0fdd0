// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/depth_camera.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/random.h"

#include "embree_scene.h"
#include "mover_view.h"
#include "pinhole.h"
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
  std::uint32_t sum = 0;
  for (int word = 0; word < 2; ++word) {
    const std::uint64_t bits = random.next();
    for (unsigned shift = 0; shift < 64; shift += 16) {
      sum += static_cast<std::uint32_t>((bits >> shift) & 0xffffU);
    }
  }
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
        movers{world.movers} {
    const FlushDenormals flush;
    scene = rtcNewScene(device.handle);
    for (int y = 0; y < camera.height_px; y += tile_rows) {
      for (int x = 0; x < camera.width_px; x += tile_columns) {
        aim_tile({x, y});
      }
    }
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // No ray slips between two faces of a solid.
    SolidMesh solids = solid_mesh(world, camera_spec.max_range_m);
    add_people_at_rest(solids, world);
    attach_quads(device.handle, scene, solids);
    rtcCommitScene(scene);
    const RTCError error = rtcGetDeviceError(device.handle);
    FLYBALL_ASSERT(error == RTC_ERROR_NONE, "Embree error %d", static_cast<int>(error));
  }
  ~Scene() { rtcReleaseScene(scene); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void aim_tile(Corner corner);
  void trace(const Eigen::Isometry3f& X_WC, std::vector<float>& depth_m) const;
  void trace_tile(const Eigen::Isometry3f& X_WC,
                  const Eigen::Vector3f* tile_C,
                  Corner corner,
                  std::vector<float>& depth_m) const;
  void add_noise(std::uint64_t sequence, std::vector<float>& depth_m) const;

  DepthCameraSpec spec;
  Intrinsics camera;
  std::uint64_t seed;
  std::vector<Mover> movers;
  EmbreeDevice device;
  RTCScene scene{};
  /// Tile by tile, as they are traced; the lanes beyond the image's edge too.
  std::vector<Eigen::Vector3f> directions_C{};
};

// Ray directions have length 1 along the optical axis, so that Embree's `tfar` is the depth.
void DepthCamera::Scene::aim_tile(Corner corner) {
  const auto focal = static_cast<float>(camera.focal_px);
  for (int lane = 0; lane < lanes; ++lane) {
    const int x = corner.x + lane % tile_columns;
    const int y = corner.y + lane / tile_columns;
    directions_C.emplace_back(
        (static_cast<float>(x) - static_cast<float>(camera.centre_x_px)) / focal,
        (static_cast<float>(y) - static_cast<float>(camera.centre_y_px)) / focal, 1.0F);
  }
}

void DepthCamera::Scene::trace(const Eigen::Isometry3f& X_WC, std::vector<float>& depth_m) const {
  const Eigen::Vector3f* tile_C = directions_C.data();
  for (int y = 0; y < camera.height_px; y += tile_rows) {
    for (int x = 0; x < camera.width_px; x += tile_columns, tile_C += lanes) {
      trace_tile(X_WC, tile_C, {x, y}, depth_m);
    }
  }
}

void DepthCamera::Scene::trace_tile(const Eigen::Isometry3f& X_WC,
                                    const Eigen::Vector3f* tile_C,
                                    Corner corner,
                                    std::vector<float>& depth_m) const {
  alignas(32) RTCRayHit8 rays{};
  alignas(32) std::array<int, lanes> valid{};
  const auto range_m = static_cast<float>(spec.max_range_m);
  for (int lane = 0; lane < lanes; ++lane) {
    const int x = corner.x + lane % tile_columns;
    const int y = corner.y + lane / tile_columns;
    valid[static_cast<std::size_t>(lane)] = x < camera.width_px && y < camera.height_px ? -1 : 0;
    aim(rays, lane, {X_WC.translation(), X_WC.linear() * tile_C[lane], range_m});
  }
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), scene, &context, &rays);
  for (int lane = 0; lane < lanes; ++lane) {
    const auto i = static_cast<std::size_t>(lane);
    // Every pixel starts as infinity: no return.
    if (valid[i] != 0 && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
      const int pixel =
          (corner.y + lane / tile_columns) * camera.width_px + corner.x + lane % tile_columns;
      depth_m[static_cast<std::size_t>(pixel)] = rays.ray.tfar[i];
    }
  }
}

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
    const double sigma_m = std::sqrt(rgbd * rgbd + spec.extra_noise_m * spec.extra_noise_m);
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
  image.depth_m.assign(static_cast<std::size_t>(image.camera.width_px) *
                           static_cast<std::size_t>(image.camera.height_px),
                       infinity);
  const FlushDenormals flush;
  scene_->trace(X_WC.cast<float>(), image.depth_m);
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
