// SPDX-License-Identifier: BSD-3-Clause
// tested-in: referee
#include "simulation/judging/picture_judge.h"

#include <utility>

namespace flyball {

PictureJudge::PictureJudge(MissionLink& link,
                           Executor& executor,
                           Topic<GroundPicture> pictures,
                           std::function<Pose()> true_pose)
    : link_{link},
      true_pose_{std::move(true_pose)},
      seen_{scanned_area_W(link.brief().site, link.brief().settings.scan), scan_cell_m} {
  executor.subscribe<GroundPicture>(pictures, [this](const GroundPicture& /*picture*/) { took(); });
}

void PictureJudge::took() {
  const auto footprint =
      footprint_of(downward_camera_pose(true_pose_()), link_.brief().settings.camera.intrinsics(),
                   link_.brief().site.ground_z_m);
  if (footprint) {
    seen_.add(*footprint);
    link_.log("footprint", row_of(*footprint));
  }
}

MissionFailure PictureJudge::objection() const {
  return seen_.covered_percent() < link_.brief().settings.scan.coverage_percent
             ? MissionFailure::incomplete
             : MissionFailure::none;
}

std::map<std::string, double> PictureJudge::figures() const {
  return {{"area_covered_percent", seen_.covered_percent()},
          {"overlap_percent", seen_.overlap_percent()},
          {"pictures", static_cast<double>(seen_.pictures())}};
}

}  // namespace flyball
