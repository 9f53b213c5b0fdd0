// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_loop
#include "simulation/simulated_board.h"

namespace flyball {

BoardReading SimulatedBoard::read() const {
  BoardReading reading;
  reading.granted = executor_.operating_point();
  reading.busy_core_s = executor_.busy_core_s();
  reading.busiest_core_s = executor_.busiest_core_s();
  reading.drops = executor_.drops();
  reading.computer_power = Watts{loop_.log().computer_w};
  reading.rotor_power = Watts{loop_.log().rotor_w};
  reading.battery_percent = loop_.battery().percent();
  if (const ThermalState* heat = drift_ != nullptr ? drift_->heat() : nullptr) {
    reading.temperature_c = heat->temperature_c();
    reading.trip_c = heat->first_trip_c().value_or(0.0);
  }
  return reading;
}

}  // namespace flyball
