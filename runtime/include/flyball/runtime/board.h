// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The companion computer as the governor meets it: what its meters say, and the operating point
/// that is asked of it.

#include "flyball/runtime/platform.h"
#include "flyball/runtime/units.h"

#include <cstdint>

namespace flyball {

/// One look at every meter.
struct BoardReading {
  OperatingPoint granted{};
  double busy_core_s{};     ///< Core-seconds of work since the start.
  double busiest_core_s{};  ///< The same of the core that worked most.
  std::uint64_t drops{};    ///< Messages and triggers since the start; see `Executor::drops`.
  std::uint64_t deadline_misses{};  ///< Of jobs, since the start.
  Watts computer_power{};
  Watts rotor_power{};
  double battery_percent{};
  double temperature_c{};  ///< 0: there is no sensor.
  double trip_c{};         ///< Above it the board takes clocks away; 0: it never does.
};

class Board {
 public:
  Board() = default;
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  virtual ~Board() = default;

  [[nodiscard]] virtual BoardReading read() const = 0;
  /// What is granted may be less; the next reading tells.
  virtual void request(const OperatingPoint& point) = 0;
};

}  // namespace flyball
