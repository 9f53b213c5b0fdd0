// SPDX-License-Identifier: BSD-3-Clause
//
// Collision check by sweeping the body's cylinder along the path, chord by chord.

#include "flyball/kernels/collision_check.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/registry.h"

#include <algorithm>

namespace {

using namespace flyball;

constexpr double chord_m = 0.5;  // On a curve of 2 m radius its arrow is 1.6 cm: inside the tube.
constexpr double free_step_m = 0.075;  // Half of the finest cell.

class SweptCylinder final : public CollisionChecker {
 public:
  PathCheck check(const OccupancyView& map,
                  const PathSpan& span,
                  const Cylinder& body,
                  Work& work) override {
    PathCheck found;
    const Path& path = *span.path;
    double s_m = span.from_m;
    while (s_m < path.length_m() && !found.blocked_at_m) {
      const double next_m = std::min(s_m + chord_m, path.length_m());
      work.add("poses", 1.0);
      if (map.segment_hits(path.at(s_m).p_W, path.at(next_m).p_W, body)) {
        found.blocked_at_m = s_m;
      }
      s_m = next_m;
    }
    found.known_free_m =
        known_free_distance(map, path, span.from_m, span.horizon_m, body, free_step_m);
    work.add("poses", found.known_free_m / free_step_m);
    return found;
  }
};

}  // namespace

FLYBALL_PLUGIN(swept_cylinder) {
  registry.add<flyball::CollisionChecker>("swept_cylinder",
                                          [] { return std::make_unique<SweptCylinder>(); });
}
