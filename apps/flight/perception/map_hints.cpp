// SPDX-License-Identifier: BSD-3-Clause
// tested-in: legs
#include "flyball/flight/perception/map_hints.h"

namespace flyball {

ClearSpace clear_over(const Vec3& ground_W, double radius_m, double height_m) {
  return {ground_W + Vec3::UnitZ() * (0.5 * height_m), {radius_m, 0.5 * height_m}};
}

}  // namespace flyball
