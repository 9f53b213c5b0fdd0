// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The world as rays of light meet it: solids, and people and movers at a moment of the mission.

#include "people/person_mesh.h"
#include "sensors/embree_scene.h"
#include "world/surface_colour.h"
#include <array>
#include <cstddef>
#include <vector>

namespace flyball {

/// Rays that are traced together; what is not valid is neither traced nor answered.
struct Packet {
  std::array<bool, lanes> valid{};
  std::array<Ray, lanes> rays{};
};

/// Where a ray ends.
struct SurfaceHit {
  bool is_surface{};  ///< False: the sky.
  Eigen::Vector3f p_W{Eigen::Vector3f::Zero()};
  Eigen::Vector3f normal_W{Eigen::Vector3f::UnitZ()};  ///< Towards the ray's origin; length 1.
  Eigen::Vector3f colour{Eigen::Vector3f::Zero()};
  float facing{};  ///< Cosine between the normal and the ray back.
};

class ColourScene {
 public:
  /// `meshes` are those of `world.people`, in their order.
  ColourScene(const World& world, std::vector<PersonMesh> meshes);
  ~ColourScene();
  ColourScene(const ColourScene&) = delete;
  ColourScene& operator=(const ColourScene&) = delete;

  /// People and movers.
  void move(MissionTime now);
  /// @param pixel_rad  Angle between two pixels. @pre Directions have length 1.
  [[nodiscard]] std::array<SurfaceHit, lanes> look(const Packet& packet, float pixel_rad) const;
  /// Whether nothing is in a ray's way.
  [[nodiscard]] std::array<bool, lanes> is_clear(const Packet& packet) const;

 private:
  struct Body {
    Person person{};
    PersonMesh mesh{};
    RTCScene shape{};
    RTCGeometry instance{};
    Eigen::Isometry3f X_WP{Eigen::Isometry3f::Identity()};
    float texel_m{1.0F};  ///< Length on the body of one width of its pictures.
  };
  struct MovingBox {
    Mover mover{};
    RTCScene shape{};
    RTCGeometry instance{};
    Eigen::Vector3f foot_W{Eigen::Vector3f::Zero()};
  };
  void attach_solids(const World& world);
  void attach(Body& body);
  void attach(MovingBox& box);
  [[nodiscard]] RTCGeometry attach_instance(RTCScene shape);
  /// Of a ray that ended on a solid or a mover. Patterns move with what they are on.
  [[nodiscard]] Eigen::Vector3f colour_of(unsigned instance,
                                          unsigned quad,
                                          const SurfacePoint& point) const;
  void colour_body(
      const Body& body, const RTCHit8& hit, int lane, SurfaceHit& seen, float footprint_m) const;

  EmbreeDevice device_;
  RTCScene scene_{};
  RTCScene solids_scene_{};
  std::vector<Material> materials_{};  ///< By quad.
  std::vector<Body> bodies_{};
  std::vector<MovingBox> boxes_{};
};

}  // namespace flyball
