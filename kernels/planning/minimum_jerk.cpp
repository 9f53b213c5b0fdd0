// SPDX-License-Identifier: BSD-3-Clause
//
// Minimum jerk (Flash and Hogan 1985, doi:10.1523/JNEUROSCI.05-07-01688.1985; for quadrotors
// Mueller, Hehn and D'Andrea 2015, doi:10.1109/TRO.2015.2479878): the body's rates, which follow
// the third derivative of the path, stay as small as possible. Pieces have degree 7, as those of
// minimum_snap, so that jerk is continuous too.

#include "flyball/kernels/smoother.h"
#include "flyball/runtime/registry.h"

#include "planning/polygon_smoother.h"

namespace {

class MinimumJerk final : public flyball::Smoother {
 public:
  flyball::Result<flyball::SmoothPath> smooth(const flyball::SmoothRequest& request,
                                              const flyball::OccupancyView& map) override {
    return flyball::smooth_polygon(request, map, 3);
  }
};

}  // namespace

FLYBALL_PLUGIN(minimum_jerk) {
  registry.add<flyball::Smoother>("minimum_jerk", [] { return std::make_unique<MinimumJerk>(); });
}
