// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_loop
#include "simulation/simulated_board.h"

namespace flyball {

SimulatedBoard::SimulatedBoard(const OperatingPoint& start,
                               double battery_percent,
                               std::uint64_t seed)
    : power_module_{battery_percent, seed} {
  unconnected_.granted = start;
}

void SimulatedBoard::connect(Executor& executor,
                             const Graph& graph,
                             const ClosedLoop& loop,
                             const ComputerDrift* drift,
                             RealtimeBoard* computer) {
  executor_ = &executor;
  graph_ = &graph;
  loop_ = &loop;
  drift_ = drift;
  computer_ = computer;
  if (computer != nullptr) {
    computer->connect(executor);
  }
  executor.on_miss([this](int, OnMiss) { ++deadline_misses_; });
  nodes_.connect(executor);
}

void SimulatedBoard::measure(double dt_s) {
  BoardReading now;
  measure_computer(now, dt_s);
  measure_battery(now, dt_s);
  const std::lock_guard lock{mutex_};
  gauges_ = now;
}

void SimulatedBoard::measure_computer(BoardReading& now, double dt_s) {
  const Watts power{loop_->log().computer_w};
  if (computer_ != nullptr) {
    const BoardReading real = computer_->meters();
    now.computer_power = power;
    now.temperature_c = real.temperature_c;
    now.trip_c = real.trip_c;
    now.rails = real.rails;
    return;
  }
  power_monitor_.add(power, dt_s);
  now.computer_power = power_monitor_.power();
  if (const ThermalState* heat = drift_ != nullptr ? drift_->heat() : nullptr) {
    now.temperature_c = thermal_zone_c(heat->temperature_c());
    now.trip_c = heat->first_trip_c().value_or(0.0);
  }
}

/// What an autopilot reports was measured, and gets no second noise.
void SimulatedBoard::measure_battery(BoardReading& now, double dt_s) {
  const Watts rotors{loop_->log().rotor_w};
  const double percent = loop_->battery().percent();
  if (const auto& reported = loop_->log().reported_battery) {
    now.rotor_power = rotors;
    now.battery_percent = reported->percent.value_or(percent);
    return;
  }
  power_module_.add(rotors, percent, dt_s);
  now.rotor_power = power_module_.rotor_power();
  now.battery_percent = power_module_.battery_percent();
}

BoardReading SimulatedBoard::gauges() const {
  const std::lock_guard lock{mutex_};
  return gauges_;
}

void SimulatedBoard::request(const OperatingPoint& point) {
  if (executor_ != nullptr) {
    executor_->set_operating_point(point);
  }
}

void SimulatedBoard::place(std::string_view node, bool on_edge) {
  for (std::size_t i = 0; executor_ != nullptr && i < graph_->nodes().size(); ++i) {
    if (graph_->nodes()[i].spec.name == node) {
      executor_->place(static_cast<int>(i), on_edge);
    }
  }
}

BoardReading SimulatedBoard::read() const {
  if (executor_ == nullptr) {
    return unconnected_;
  }
  BoardReading reading = gauges();
  reading.granted = executor_->operating_point();
  reading.busy_core_s = executor_->busy_core_s();
  reading.busiest_core_s = executor_->busiest_core_s();
  reading.drops = executor_->drops();
  reading.deadline_misses = deadline_misses_;
  return reading;
}

}  // namespace flyball
