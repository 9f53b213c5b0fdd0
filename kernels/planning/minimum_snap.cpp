// SPDX-License-Identifier: BSD-3-Clause
//
// Minimum snap (Mellinger and Kumar 2011, doi:10.1109/ICRA.2011.5980409): the rotors' speeds, which
// follow the fourth derivative of the path, change as little as possible.

#include "flyball/kernels/smoother.h"
#include "flyball/runtime/registry.h"

#include "planning/polygon_smoother.h"

namespace {

class MinimumSnap final : public flyball::Smoother {
 public:
  flyball::Result<flyball::SmoothPath> smooth(const flyball::SmoothRequest& request,
                                              const flyball::OccupancyView& map) override {
    return flyball::smooth_polygon(request, map, 4);
  }
};

}  // namespace

FLYBALL_PLUGIN(minimum_snap) {
  registry.add<flyball::Smoother>("minimum_snap", [] { return std::make_unique<MinimumSnap>(); });
}
