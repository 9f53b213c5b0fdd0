// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which ground the pictures of a scan truly show.

#include "flyball/flight/exploration/ground_coverage.h"
#include "flyball/flight/exploration/ground_pictures.h"
#include "flyball/runtime/executor.h"

#include "simulation/judging/judge.h"
#include "simulation/mission_link.h"
#include <functional>

namespace flyball {

class PictureJudge final : public Judge {
 public:
  /// All arguments outlive the judge, which listens to the topic from now on.
  /// @param true_pose  X_WB now.
  PictureJudge(MissionLink& link,
               Executor& executor,
               Topic<GroundPicture> pictures,
               std::function<Pose()> true_pose);

  /// `incomplete` when less was covered than the scan asks for.
  [[nodiscard]] MissionFailure objection() const override;
  /// `area_covered_percent`, `overlap_percent`, `pictures`.
  [[nodiscard]] std::map<std::string, double> figures() const override;

 private:
  void took();

  MissionLink& link_;
  std::function<Pose()> true_pose_;
  GroundCoverage seen_;
};

}  // namespace flyball
