// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether a payload was released where it was asked for.

#include "flyball/flight/vehicle_port.h"
#include "flyball/runtime/executor.h"
#include "flyball/runtime/geometry.h"

#include "simulation/judging/judge.h"
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace flyball {

class DeliveryJudge final : public Judge {
 public:
  /// @param where  Asks where the vehicle truly is. Both it and the executor outlive the judge,
  ///               which listens to the topic from now on.
  DeliveryJudge(Executor& executor,
                Topic<FlightCommand> command,
                const Vec3& goal_W,
                std::function<Vec3()> where);

  /// `misdelivered` when the last payload was released more than 2 m from the goal, along the
  /// ground.
  [[nodiscard]] MissionFailure objection() const override;
  /// `delivery_error_m`, where one was released.
  [[nodiscard]] std::map<std::string, double> figures() const override;

 private:
  std::optional<double> error_m_{};
};

}  // namespace flyball
