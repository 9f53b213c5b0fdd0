// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The modeled companion computer, its meters and the vehicle's battery gauge, as a governor reads
/// them: what is modeled, with the steps and the noise that real meters have.

#include "flyball/runtime/board.h"
#include "flyball/runtime/node_meter.h"
#include "flyball/runtime/realtime/realtime_board.h"
#include "flyball/sim/power_meters.h"

#include "simulation/closed_loop.h"
#include "simulation/computer_drift.h"
#include <atomic>
#include <mutex>

namespace flyball {

/// The simulator's thread moves the gauges (`measure`); whichever thread the governor's node runs
/// on reads them.
class SimulatedBoard final : public Board {
 public:
  /// Until it is connected it says that this is granted, and hears no request.
  SimulatedBoard(const OperatingPoint& start, double battery_percent, std::uint64_t seed);
  /// All arguments outlive the board; `drift` may be null: then nothing is known of heat. With a
  /// `computer`, which runs the nodes and is not modeled, watts and heat are what it measures.
  void connect(Executor& executor,
               const Graph& graph,
               const ClosedLoop& loop,
               const ComputerDrift* drift,
               RealtimeBoard* computer = nullptr);
  /// The meters follow what the simulator says now, `dt_s` after the last call; 0 at the start,
  /// before the first decision.
  void measure(double dt_s);

  [[nodiscard]] BoardReading read() const override;
  [[nodiscard]] NodeUse use_of(int node) const override { return nodes_.of(node); }
  void request(const OperatingPoint& point) override;
  void place(std::string_view node, bool on_edge) override;

 private:
  [[nodiscard]] BoardReading gauges() const;
  void measure_computer(BoardReading& now, double dt_s);
  void measure_battery(BoardReading& now, double dt_s);

  BoardReading unconnected_{};
  Executor* executor_{};
  const Graph* graph_{};
  const ClosedLoop* loop_{};
  const ComputerDrift* drift_{};
  const RealtimeBoard* computer_{};
  std::atomic<std::uint64_t> deadline_misses_{};
  NodeMeter nodes_{};
  PowerMonitor power_monitor_{};
  PowerModule power_module_;
  mutable std::mutex mutex_{};  ///< Of `gauges_`.
  BoardReading gauges_{};       ///< Power, battery and heat; the rest is left out.
};

}  // namespace flyball
