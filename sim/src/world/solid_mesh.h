// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The world's surfaces as quads, for ray casting.

#include "flyball/sim/world.h"

#include <array>
#include <cstdint>
#include <vector>

namespace flyball {

struct SolidMesh {
  std::vector<std::array<float, 3>> vertices_W{};
  std::vector<std::array<std::uint32_t, 4>> quads{};
  std::vector<Material> materials{};  ///< Of each quad that `solid_mesh` made.
};

/// Boxes, pillars (prisms of 24 faces around the cylinder, up to .9 % of the radius outside it) and
/// the ground, which reaches `margin_m` beyond everything else.
[[nodiscard]] SolidMesh solid_mesh(const World& world, double margin_m);

}  // namespace flyball
