// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_loop
#include "simulation/simulated_board.h"

namespace flyball {

void SimulatedBoard::connect(Executor& executor,
                             const ClosedLoop& loop,
                             const ComputerDrift* drift) {
  executor_ = &executor;
  loop_ = &loop;
  drift_ = drift;
  executor.on_miss([this](int, OnMiss) { ++deadline_misses_; });
}

void SimulatedBoard::request(const OperatingPoint& point) {
  if (executor_ != nullptr) {
    executor_->set_operating_point(point);
  }
}

BoardReading SimulatedBoard::read() const {
  if (executor_ == nullptr) {
    return unconnected_;
  }
  BoardReading reading;
  reading.granted = executor_->operating_point();
  reading.busy_core_s = executor_->busy_core_s();
  reading.busiest_core_s = executor_->busiest_core_s();
  reading.drops = executor_->drops();
  reading.deadline_misses = deadline_misses_;
  reading.computer_power = Watts{loop_->log().computer_w};
  reading.rotor_power = Watts{loop_->log().rotor_w};
  reading.battery_percent = loop_->battery().percent();
  if (const ThermalState* heat = drift_ != nullptr ? drift_->heat() : nullptr) {
    reading.temperature_c = heat->temperature_c();
    reading.trip_c = heat->first_trip_c().value_or(0.0);
  }
  return reading;
}

}  // namespace flyball
