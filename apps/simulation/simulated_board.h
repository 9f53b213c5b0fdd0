// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The modeled companion computer, its meters and the vehicle's battery gauge, as a governor reads
/// them.

#include "flyball/runtime/board.h"

#include "simulation/closed_loop.h"
#include "simulation/computer_drift.h"

namespace flyball {

class SimulatedBoard final : public Board {
 public:
  /// All arguments outlive the board; `drift` may be null: then nothing is known of heat.
  SimulatedBoard(VirtualExecutor& executor, const ClosedLoop& loop, const ComputerDrift* drift)
      : executor_{executor}, loop_{loop}, drift_{drift} {}

  [[nodiscard]] BoardReading read() const override;
  void request(const OperatingPoint& point) override { executor_.set_operating_point(point); }

 private:
  VirtualExecutor& executor_;
  const ClosedLoop& loop_;
  const ComputerDrift* drift_;
};

}  // namespace flyball
