// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/colour_camera.h"

#include "flyball/runtime/camera_spec.h"

#include "sensors/colour_scene.h"
#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

namespace flyball {
namespace {

// Weights of the light that reaches a surface: own choices, so that sunlit and shaded sides of
// usual colours stay inside the 8 bits, as an automatic exposure would have it.
constexpr float sun_light = 0.75F;
constexpr float sky_light = 0.40F;     // From above; half of it from the side.
constexpr float camera_light = 0.15F;  // Shape where neither reaches: indoors.
constexpr float shadow_gap_m = 1e-3F;  // The ray to the sun starts off the surface.

std::uint8_t byte_of(float share) {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): positive, and lround is a call for each colour
  return static_cast<std::uint8_t>(std::clamp(share, 0.0F, 1.0F) * 255.0F + 0.5F);
}

Eigen::Vector3f lit(const SurfaceHit& hit, const Eigen::Vector3f& to_sun_W, bool in_sun) {
  const float sun = in_sun ? std::max(hit.normal_W.dot(to_sun_W), 0.0F) : 0.0F;
  const float light =
      sun_light * sun + sky_light * (0.75F + 0.25F * hit.normal_W.z()) + camera_light * hit.facing;
  return hit.colour * light * 1.25F;
}

}  // namespace

Intrinsics ColourCameraSpec::intrinsics() const {
  return pinhole(width_px, height_px, horizontal_field_rad);
}

struct ColourCamera::Scene {
  Scene(const World& world, const ColourCameraSpec& camera_spec, std::vector<PersonMesh> meshes)
      : spec{camera_spec}, camera{camera_spec.intrinsics()}, things{world, std::move(meshes)} {
    const double level = std::cos(spec.sun_elevation_rad);
    to_sun_W = Vec3{level * std::cos(spec.sun_azimuth_rad), level * std::sin(spec.sun_azimuth_rad),
                    std::sin(spec.sun_elevation_rad)}
                   .cast<float>();
  }

  void render_tile(const Eigen::Isometry3f& X_WC, Corner corner, ColourImage& image) const;
  [[nodiscard]] Packet towards_sun(const std::array<SurfaceHit, lanes>& hits) const;

  ColourCameraSpec spec;
  Intrinsics camera;
  std::mutex mutex{};  ///< Of `things`, whose people are moved to where they are in each picture.
  ColourScene things;
  Eigen::Vector3f to_sun_W{};
};

Packet ColourCamera::Scene::towards_sun(const std::array<SurfaceHit, lanes>& hits) const {
  Packet packet;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    packet.valid[i] = hits[i].is_surface && hits[i].normal_W.dot(to_sun_W) > 0.0F;
    packet.rays[i] = {hits[i].p_W + shadow_gap_m * hits[i].normal_W, to_sun_W, 1e4F};
  }
  return packet;
}

void ColourCamera::Scene::render_tile(const Eigen::Isometry3f& X_WC,
                                      Corner corner,
                                      ColourImage& image) const {
  const auto focal = static_cast<float>(camera.focal_px);
  Packet packet;
  for (int lane = 0; lane < lanes; ++lane) {
    const int x = corner.x + lane % tile_columns;
    const int y = corner.y + lane / tile_columns;
    const Eigen::Vector3f direction_C{
        (static_cast<float>(x) - static_cast<float>(camera.centre_x_px)) / focal,
        (static_cast<float>(y) - static_cast<float>(camera.centre_y_px)) / focal, 1.0F};
    const auto i = static_cast<std::size_t>(lane);
    packet.valid[i] = x < camera.width_px && y < camera.height_px;
    packet.rays[i] = {X_WC.translation(), X_WC.linear() * direction_C.normalized(), 1e4F};
  }
  const auto hits = things.look(packet, 1.0F / focal);
  const auto sees_sun = things.is_clear(towards_sun(hits));
  for (int lane = 0; lane < lanes; ++lane) {
    const auto i = static_cast<std::size_t>(lane);
    if (!packet.valid[i]) {
      continue;
    }
    const Eigen::Vector3f colour = hits[i].is_surface
                                       ? lit(hits[i], to_sun_W, sees_sun[i])
                                       : sky_colour(packet.rays[i].direction, to_sun_W);
    const int pixel =
        (corner.y + lane / tile_columns) * camera.width_px + corner.x + lane % tile_columns;
    std::uint8_t* rgb = &image.rgb[3 * static_cast<std::size_t>(pixel)];
    rgb[0] = byte_of(colour.x());
    rgb[1] = byte_of(colour.y());
    rgb[2] = byte_of(colour.z());
  }
}

ColourCamera::ColourCamera(std::unique_ptr<Scene> scene) : scene_{std::move(scene)} {}

ColourCamera::~ColourCamera() = default;

Result<std::unique_ptr<ColourCamera>> ColourCamera::make(const World& world,
                                                         const ColourCameraSpec& spec) {
  std::vector<PersonMesh> meshes;
  for (const Person& person : world.people) {
    auto mesh = load_person_mesh(person.look, spec.people_folder);
    if (!mesh) {
      return mesh.error();
    }
    meshes.push_back(std::move(*mesh));
  }
  return std::unique_ptr<ColourCamera>{
      new ColourCamera{std::make_unique<Scene>(world, spec, std::move(meshes))}};
}

const ColourCameraSpec& ColourCamera::spec() const {
  return scene_->spec;
}

ColourImage ColourCamera::capture(const Pose& X_WC, MissionTime now, std::uint64_t sequence) const {
  ColourImage image{now, sequence, scene_->camera, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(image.camera.width_px) *
                   static_cast<std::size_t>(image.camera.height_px));
  render(X_WC, {whole(image.camera)}, image);
  return image;
}

void ColourCamera::render(const Pose& X_WC,
                          const std::vector<PixelRegion>& regions,
                          ColourImage& into) const {
  const std::lock_guard lock{scene_->mutex};
  const FlushDenormals flush;
  scene_->things.move(into.captured);
  const Eigen::Isometry3f X_WC_single = X_WC.cast<float>();
  for (const PixelRegion& region : regions) {
    // Always the tiles of the whole image: which rays travel together may show in the last bit.
    const int left = region.x_px - region.x_px % tile_columns;
    const int top = region.y_px - region.y_px % tile_rows;
    for (int y = top; y < region.y_px + region.height_px; y += tile_rows) {
      for (int x = left; x < region.x_px + region.width_px; x += tile_columns) {
        scene_->render_tile(X_WC_single, {x, y}, into);
      }
    }
  }
}

ColourFrame ColourCamera::frame(const CameraPose& pose,
                                MissionTime now,
                                std::uint64_t sequence) const {
  return {now,
          sequence,
          scene_->camera,
          pose.X_LC,
          {{now, sequence, scene_->camera, {}},
           [this, X_WC = pose.X_WC](const std::vector<PixelRegion>& regions, ColourImage& into) {
             render(X_WC, regions, into);
           }}};
}

std::optional<ImageBox> box_of(const Person& person,
                               MissionTime now,
                               const Pose& X_WC,
                               const Intrinsics& camera) {
  constexpr int sides = 8;
  constexpr double step_rad = 6.283185307179586 / sides;
  const Vec3 foot_W = person.at(now).foot_W;
  Eigen::AlignedBox2d box;
  for (int i = 0; i < 2 * sides; ++i) {
    const Vec3 rim{person.radius_m * std::cos(i * step_rad),
                   person.radius_m * std::sin(i * step_rad), i < sides ? 0.0 : person.height_m};
    const Vec3 p_C = X_WC.inverse() * Vec3{foot_W + rim};
    if (p_C.z() < 0.1) {
      return std::nullopt;
    }
    box.extend(Eigen::Vector2d{camera.centre_x_px + camera.focal_px * p_C.x() / p_C.z() + 0.5,
                               camera.centre_y_px + camera.focal_px * p_C.y() / p_C.z() + 0.5});
  }
  const Eigen::AlignedBox2d image{Eigen::Vector2d::Zero(),
                                  Eigen::Vector2d{camera.width_px, camera.height_px}};
  if (!image.intersects(box)) {
    return std::nullopt;
  }
  return ImageBox{box.min().x(), box.min().y(), box.sizes().x(), box.sizes().y()};
}

}  // namespace flyball
