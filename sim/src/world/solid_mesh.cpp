// SPDX-License-Identifier: BSD-3-Clause
// tested-in: colour_camera
#include "world/solid_mesh.h"

#include <cmath>

namespace flyball {
namespace {

std::uint32_t add_vertex(SolidMesh& mesh, const Vec3& p_W) {
  mesh.vertices_W.push_back(
      {static_cast<float>(p_W.x()), static_cast<float>(p_W.y()), static_cast<float>(p_W.z())});
  return static_cast<std::uint32_t>(mesh.vertices_W.size() - 1);
}

void add_box(SolidMesh& mesh, const Aabb& box) {
  std::uint32_t first = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{(corner & 1) != 0 ? box.max.x() : box.min.x(),
                 (corner & 2) != 0 ? box.max.y() : box.min.y(),
                 (corner & 4) != 0 ? box.max.z() : box.min.z()};
    const std::uint32_t index = add_vertex(mesh, p);
    first = corner == 0 ? index : first;
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    mesh.quads.push_back({first + f[0], first + f[1], first + f[2], first + f[3]});
  }
}

// Circumscribed: a camera that believes the prism never flies into the cylinder.
void add_pillar(SolidMesh& mesh, const Pillar& pillar) {
  constexpr std::uint32_t sides = 24;
  constexpr double step_rad = 6.283185307179586 / sides;
  const double corner_m = pillar.radius_m / std::cos(0.5 * step_rad);
  const auto first = static_cast<std::uint32_t>(mesh.vertices_W.size());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const Vec3 out{corner_m * std::cos(i * step_rad), corner_m * std::sin(i * step_rad), 0.0};
    add_vertex(mesh, pillar.foot_W + out);
    add_vertex(mesh, pillar.foot_W + out + Vec3{0.0, 0.0, pillar.height_m});
  }
  const std::uint32_t top = add_vertex(mesh, pillar.foot_W + Vec3{0.0, 0.0, pillar.height_m});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = first + 2 * i;
    const std::uint32_t b = first + 2 * ((i + 1) % sides);
    mesh.quads.push_back({a, b, b + 1, a + 1});
    mesh.quads.push_back(
        {a + 1, b + 1, top, top});  // A triangle is a quad whose last two coincide.
  }
}

// Tiles, because one quad over kilometres would lose centimetres in single precision.
void add_ground(SolidMesh& mesh, const World& world, double margin_m) {
  constexpr double tile_m = 50.0;
  Eigen::AlignedBox2d area{Eigen::Vector2d{world.bounds_W.min.head<2>()},
                           Eigen::Vector2d{world.bounds_W.max.head<2>()}};
  area.extend(Eigen::Vector2d{world.start_W.head<2>()});
  area.extend(Eigen::Vector2d{world.goal_W.head<2>()});
  const Eigen::Vector2d low = area.min().array() - margin_m;
  const Eigen::Vector2d size = area.sizes().array() + 2.0 * margin_m;
  const int nx = static_cast<int>(size.x() / tile_m) + 1;
  const int ny = static_cast<int>(size.y() / tile_m) + 1;
  const auto first = static_cast<std::uint32_t>(mesh.vertices_W.size());
  for (int y = 0; y <= ny; ++y) {
    for (int x = 0; x <= nx; ++x) {
      add_vertex(mesh,
                 {low.x() + size.x() * x / nx, low.y() + size.y() * y / ny, world.ground_z_m});
    }
  }
  const auto row = static_cast<std::uint32_t>(nx + 1);
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(ny); ++y) {
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = first + y * row + x;
      mesh.quads.push_back({a, a + 1, a + 1 + row, a + row});
    }
  }
}

}  // namespace

SolidMesh solid_mesh(const World& world, double margin_m) {
  SolidMesh mesh;
  const auto made_of = [&mesh](Material material) {
    mesh.materials.resize(mesh.quads.size(), material);
  };
  for (std::size_t i = 0; i < world.boxes.size(); ++i) {
    add_box(mesh, world.boxes[i]);
    made_of(i < world.box_materials.size() ? world.box_materials[i] : Material::plaster);
  }
  for (const Pillar& pillar : world.pillars) {
    add_pillar(mesh, pillar);
    made_of(pillar.material);
  }
  if (world.has_ground) {
    add_ground(mesh, world, margin_m);
    made_of(world.ground_material);
  }
  return mesh;
}

}  // namespace flyball
