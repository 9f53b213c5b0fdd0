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
  /// Until it is connected it says that this is granted, and hears no request.
  explicit SimulatedBoard(const OperatingPoint& start) { unconnected_.granted = start; }
  /// All arguments outlive the board; `drift` may be null: then nothing is known of heat.
  void connect(Executor& executor, const ClosedLoop& loop, const ComputerDrift* drift);

  [[nodiscard]] BoardReading read() const override;
  void request(const OperatingPoint& point) override;

 private:
  BoardReading unconnected_{};
  Executor* executor_{};
  const ClosedLoop* loop_{};
  const ComputerDrift* drift_{};
  std::uint64_t deadline_misses_{};
};

}  // namespace flyball
