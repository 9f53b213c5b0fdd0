// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How people look: textured meshes from files that the system's packages bring.

#include "flyball/runtime/result.h"

#include "world/texture.h"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace flyball {

/// Standing at the origin, x forward, y left, z up, one metre tall.
struct PersonMesh {
  std::vector<std::array<float, 3>> vertices{};
  std::vector<Eigen::Vector3f> normals{};         ///< Of each vertex; length 1.
  std::vector<Eigen::Vector2f> texture_places{};  ///< Of each vertex; (0, 0) is the lower left.
  std::vector<std::array<std::uint32_t, 3>> triangles{};
  std::vector<std::uint32_t> parts{};  ///< Of each triangle: index into `textures`.
  std::vector<Texture> textures{};
};

/// Puts it on its back, head towards -x, its middle over the origin: one metre long then.
void lay_down(PersonMesh& person);

/// The mesh of a look (see `person_looks`).
///
/// @error `not_found`: no such look, or its file is not in `folder`; `invalid_input`: a file that
///        is none of these meshes. Names the package that brings it.
[[nodiscard]] Result<PersonMesh> load_person_mesh(const std::string& look,
                                                  const std::string& folder);

}  // namespace flyball
