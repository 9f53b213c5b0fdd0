// SPDX-License-Identifier: BSD-3-Clause
// tested-in: referee
#include "simulation/judging/map_judge.h"

namespace flyball {

void MapJudge::prepare() {
  judge_ = make_exploration_judge(link_.brief(), world_);
}

void MapJudge::look(MissionTime /*now*/) {
  if (!link_.map()) {
    return;
  }
  coverage_percent_ = judge_->coverage_percent(*link_.map()->map);
  link_.log("coverage", {{"coverage_percent", coverage_percent_}});
}

MissionFailure MapJudge::objection() const {
  return coverage_percent_ < least_percent_ ? MissionFailure::incomplete : MissionFailure::none;
}

std::map<std::string, double> MapJudge::figures() const {
  if (!judge_) {
    return {};
  }
  const MapAgreement agreement = judge_->agreement(mapper_);
  return {{"coverage_percent", coverage_percent_},
          {"map_precision", agreement.precision},
          {"map_recall", agreement.recall}};
}

}  // namespace flyball
