// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/random.h"

namespace flyball {

/// Three independent standard normal numbers, x first: the order of evaluation of a constructor's
/// arguments is not ours.
inline Vec3 normal3(RandomStream& noise) {
  Vec3 v;
  for (double& component : v) {
    component = noise.normal();
  }
  return v;
}

}  // namespace flyball
