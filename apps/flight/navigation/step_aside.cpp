// SPDX-License-Identifier: BSD-3-Clause
// tested-in: navigator
#include "flyball/flight/navigation/step_aside.h"

#include <array>
#include <cmath>

namespace flyball {
namespace {

// Chosen: a few millimetres are enough for a cell that only just overlaps the tube, and a step
// longer than the tube is wide would need a path.
constexpr std::array<double, 4> steps_m{0.005, 0.015, 0.03, 0.06};
constexpr std::size_t turns = 8;
constexpr double eighth_rad = 0.7853981633974483;

}  // namespace

std::optional<Vec3> place_aside_W(const Situation& situation, const Vec3& here_W) {
  const auto is_blocked = [&](const Vec3& p_W) {
    return situation.map.body_state(p_W, situation.brief.narrow_body()) == CellState::occupied;
  };
  if (!is_blocked(here_W)) {
    return here_W;
  }
  for (std::size_t i = 0; i < turns * steps_m.size(); ++i) {
    const double yaw_rad = static_cast<double>(i % turns) * eighth_rad;
    const Vec3 p_W = here_W + steps_m[i / turns] * Vec3{std::cos(yaw_rad), std::sin(yaw_rad), 0.0};
    if (!is_blocked(p_W)) {
      return p_W;
    }
  }
  return std::nullopt;
}

}  // namespace flyball
