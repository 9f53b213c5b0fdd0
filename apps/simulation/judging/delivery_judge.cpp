// SPDX-License-Identifier: BSD-3-Clause
// tested-in: referee
#include "simulation/judging/delivery_judge.h"

#include <utility>

namespace flyball {
namespace {

constexpr double delivered_within_m = 2.0;  // Chosen: about what a plain satellite receiver errs.

}  // namespace

DeliveryJudge::DeliveryJudge(Executor& executor,
                             Topic<FlightCommand> command,
                             const Vec3& goal_W,
                             std::function<Vec3()> where) {
  executor.subscribe<FlightCommand>(
      command, [this, goal_W, where = std::move(where)](const FlightCommand& given) {
        if (given.kind == FlightCommand::Kind::release_payload) {
          error_m_ = (where() - goal_W).head<2>().norm();
        }
      });
}

MissionFailure DeliveryJudge::objection() const {
  return error_m_.value_or(0.0) > delivered_within_m ? MissionFailure::misdelivered
                                                     : MissionFailure::none;
}

std::map<std::string, double> DeliveryJudge::figures() const {
  return error_m_ ? std::map<std::string, double>{{"delivery_error_m", *error_m_}}
                  : std::map<std::string, double>{};
}

}  // namespace flyball
