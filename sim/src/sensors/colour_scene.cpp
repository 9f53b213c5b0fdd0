// SPDX-License-Identifier: BSD-3-Clause
// tested-in: colour_camera
#include "sensors/colour_scene.h"

#include <cmath>

namespace flyball {
namespace {

constexpr double ground_reach_m = 300.0;  // Beyond it the image shows the horizon.
constexpr unsigned solids_instance = 0;   // The first one; people follow, then movers.

RTCGeometry triangles_of(RTCDevice device, const PersonMesh& mesh, float length_m) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<std::array<float, 3>*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(mesh.vertices[0]), mesh.vertices.size()));
  auto* indices = static_cast<std::array<std::uint32_t, 3>*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              sizeof(mesh.triangles[0]), mesh.triangles.size()));
  FLYBALL_ASSERT(vertices != nullptr && indices != nullptr,
                 "Embree has no memory for %zu triangles", mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto& p = mesh.vertices[i];
    vertices[i] = {length_m * p[0], length_m * p[1], length_m * p[2]};
  }
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), indices);
  rtcCommitGeometry(geometry);
  return geometry;
}

void place(RTCGeometry instance, const Eigen::Isometry3f& X_WI) {
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, X_WI.matrix().data());
  rtcCommitGeometry(instance);
}

template <class Rays>
void set_ray(Rays& rays, std::size_t i, const Ray& ray) {
  rays.org_x[i] = ray.origin.x();
  rays.org_y[i] = ray.origin.y();
  rays.org_z[i] = ray.origin.z();
  rays.dir_x[i] = ray.direction.x();
  rays.dir_y[i] = ray.direction.y();
  rays.dir_z[i] = ray.direction.z();
  rays.tnear[i] = 0.0F;
  rays.tfar[i] = ray.range;
  rays.time[i] = 0.0F;
  rays.mask[i] = ~0U;
}

}  // namespace

ColourScene::ColourScene(const World& world, std::vector<PersonMesh> meshes) {
  const FlushDenormals flush;
  scene_ = rtcNewScene(device_.handle);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
  attach_solids(world);
  bodies_.resize(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    bodies_[i].person = world.people[i];
    bodies_[i].mesh = std::move(meshes[i]);
    attach(bodies_[i]);
  }
  for (const Mover& mover : world.movers) {
    boxes_.push_back({mover});
    attach(boxes_.back());
  }
  move(MissionTime{});
  const RTCError error = rtcGetDeviceError(device_.handle);
  FLYBALL_ASSERT(error == RTC_ERROR_NONE, "Embree error %d", static_cast<int>(error));
}

ColourScene::~ColourScene() {
  rtcReleaseScene(scene_);
  rtcReleaseScene(solids_scene_);
  for (const Body& body : bodies_) {
    rtcReleaseGeometry(body.instance);
    rtcReleaseScene(body.shape);
  }
  for (const MovingBox& box : boxes_) {
    rtcReleaseGeometry(box.instance);
    rtcReleaseScene(box.shape);
  }
}

RTCGeometry ColourScene::attach_instance(RTCScene shape) {
  rtcCommitScene(shape);
  RTCGeometry instance = rtcNewGeometry(device_.handle, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, shape);
  rtcCommitGeometry(instance);
  rtcAttachGeometry(scene_, instance);
  return instance;
}

void ColourScene::attach_solids(const World& world) {
  solids_scene_ = rtcNewScene(device_.handle);
  rtcSetSceneFlags(solids_scene_, RTC_SCENE_FLAG_ROBUST);
  SolidMesh solids = solid_mesh(world, ground_reach_m);
  attach_quads(device_.handle, solids_scene_, solids);
  materials_ = std::move(solids.materials);
  rtcReleaseGeometry(attach_instance(solids_scene_));
}

void ColourScene::attach(Body& body) {
  body.shape = rtcNewScene(device_.handle);
  const Person& person = body.person;
  const auto length_m = static_cast<float>(person.lies ? 2.0 * person.radius_m : person.height_m);
  if (person.lies) {
    lay_down(body.mesh);
  }
  RTCGeometry triangles = triangles_of(device_.handle, body.mesh, length_m);
  rtcAttachGeometry(body.shape, triangles);
  rtcReleaseGeometry(triangles);
  body.texel_m = length_m;  // The pictures show about one body's height across.
  body.instance = attach_instance(body.shape);
}

void ColourScene::attach(MovingBox& box) {
  box.shape = rtcNewScene(device_.handle);
  Mover resting;
  resting.size_m = box.mover.size_m;
  World alone;
  alone.has_ground = false;
  alone.boxes = {box_at(resting, MissionTime{})};
  attach_quads(device_.handle, box.shape, solid_mesh(alone, 0.0));
  box.instance = attach_instance(box.shape);
}

void ColourScene::move(MissionTime now) {
  for (Body& body : bodies_) {
    const PersonPose pose = body.person.at(now);
    Pose X_WP = Pose::Identity();
    X_WP.linear() = Eigen::AngleAxisd{pose.heading_rad, Vec3::UnitZ()}.toRotationMatrix();
    X_WP.translation() = pose.foot_W;
    body.X_WP = X_WP.cast<float>();
    place(body.instance, body.X_WP);
  }
  for (MovingBox& box : boxes_) {
    const Aabb there = box_at(box.mover, now);
    const Vec3 middle_W = 0.5 * (there.min + there.max);
    box.foot_W = Vec3{middle_W.x(), middle_W.y(), there.min.z()}.cast<float>();
    place(box.instance, Eigen::Isometry3f{Eigen::Translation3f{box.foot_W}});
  }
  rtcCommitScene(scene_);
}

void ColourScene::colour_body(
    const Body& body, const RTCHit8& hit, int lane, SurfaceHit& seen, float footprint_m) const {
  const auto triangle = hit.primID[lane];
  const auto& corners = body.mesh.triangles[triangle];
  const float u = hit.u[lane];
  const float v = hit.v[lane];
  const auto blend = [&](const auto& of) {
    return ((1.0F - u - v) * of[corners[0]] + u * of[corners[1]] + v * of[corners[2]]).eval();
  };
  seen.normal_W = (body.X_WP.linear() * blend(body.mesh.normals)).normalized();
  seen.colour = body.mesh.textures[body.mesh.parts[triangle]].at(blend(body.mesh.texture_places),
                                                                 footprint_m / body.texel_m);
}

Eigen::Vector3f ColourScene::colour_of(unsigned instance,
                                       unsigned quad,
                                       const SurfacePoint& point) const {
  if (instance == solids_instance) {
    return surface_colour(materials_[quad], point);
  }
  SurfacePoint on_box = point;
  on_box.p_W -= boxes_[instance - 1U - bodies_.size()].foot_W;
  return surface_colour(Material::plaster, on_box);  // Nobody says what a mover is made of.
}

std::array<SurfaceHit, lanes> ColourScene::look(const Packet& packet, float pixel_rad) const {
  alignas(32) RTCRayHit8 rays{};
  alignas(32) std::array<int, lanes> valid{};
  for (std::size_t i = 0; i < lanes; ++i) {
    valid[i] = packet.valid[i] ? -1 : 0;
    set_ray(rays.ray, i, packet.rays[i]);
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), scene_, &context, &rays);
  std::array<SurfaceHit, lanes> hits{};
  for (int lane = 0; lane < lanes; ++lane) {
    const auto i = static_cast<std::size_t>(lane);
    if (!packet.valid[i] || rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
      continue;
    }
    SurfaceHit& seen = hits[i];
    const Ray& ray = packet.rays[i];
    const float range_m = rays.ray.tfar[i];
    seen.is_surface = true;
    seen.p_W = ray.origin + range_m * ray.direction;
    seen.normal_W =
        Eigen::Vector3f{rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]}.normalized();
    const unsigned instance = rays.hit.instID[0][i];
    const bool is_person = instance != solids_instance && instance <= bodies_.size();
    if (is_person) {
      colour_body(bodies_[instance - 1U], rays.hit, lane, seen, range_m * pixel_rad);
    }
    seen.facing = -seen.normal_W.dot(ray.direction);
    if (seen.facing < 0.0F) {  // Faces have two sides.
      seen.normal_W = -seen.normal_W;
      seen.facing = -seen.facing;
    }
    if (!is_person) {
      // Along the view a pixel covers more of a surface that it grazes; half way between the two.
      const float footprint_m = range_m * pixel_rad / std::sqrt(std::max(seen.facing, 0.01F));
      seen.colour = colour_of(instance, rays.hit.primID[i], {seen.p_W, seen.normal_W, footprint_m});
    }
  }
  return hits;
}

std::array<bool, lanes> ColourScene::is_clear(const Packet& packet) const {
  alignas(32) RTCRay8 rays{};
  alignas(32) std::array<int, lanes> valid{};
  for (std::size_t i = 0; i < lanes; ++i) {
    valid[i] = packet.valid[i] ? -1 : 0;
    set_ray(rays, i, packet.rays[i]);
  }
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded8(valid.data(), scene_, &context, &rays);
  std::array<bool, lanes> clear{};
  for (std::size_t i = 0; i < lanes; ++i) {
    clear[i] = packet.valid[i] && rays.tfar[i] >= 0.0F;
  }
  return clear;
}

}  // namespace flyball
