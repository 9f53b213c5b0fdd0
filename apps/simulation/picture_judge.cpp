// SPDX-License-Identifier: BSD-3-Clause
// tested-in: referee
#include "simulation/picture_judge.h"

#include <utility>

namespace flyball {

PictureJudge::PictureJudge(MissionContext& context,
                           Executor& executor,
                           Topic<GroundPicture> pictures,
                           std::function<Pose()> true_pose)
    : context_{context},
      true_pose_{std::move(true_pose)},
      seen_{scanned_area_W(context.brief, context.settings.scan), scan_cell_m} {
  executor.subscribe<GroundPicture>(pictures,
                                    [this](const GroundPicture& picture) { took(picture.taken); });
}

void PictureJudge::took(MissionTime now) {
  const auto footprint =
      footprint_of(downward_camera_pose(true_pose_()), context_.settings.camera.intrinsics(),
                   context_.brief.ground_z_m);
  if (footprint) {
    seen_.add(*footprint);
    record(*footprint, now, context_.recorder);
  }
}

MissionFailure PictureJudge::objection() const {
  return seen_.covered_percent() < context_.settings.scan.coverage_percent
             ? MissionFailure::incomplete
             : MissionFailure::none;
}

std::map<std::string, double> PictureJudge::figures() const {
  return {{"area_covered_percent", seen_.covered_percent()},
          {"overlap_percent", seen_.overlap_percent()},
          {"pictures", static_cast<double>(seen_.pictures())}};
}

}  // namespace flyball
