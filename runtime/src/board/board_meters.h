// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a board draws and how hot it is, from the best meter that it has.

#include "flyball/runtime/board.h"
#include "flyball/runtime/board/board_file.h"
#include "flyball/runtime/board/board_inventory.h"
#include "flyball/runtime/time.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Power of the whole board: its input rail, else RAPL's psys, else RAPL's packages. Never the sum
/// of rails: they overlap and leave parts out (jetson_stats issues 51, 344, 900).
class PowerMeter {
 public:
  PowerMeter(const LinuxSystem& system, const BoardInventory& found, const BoardFile& board);

  /// For people: `VDD_IN`, `psys`, `package-0 (without the board)`; empty: there is no meter.
  [[nodiscard]] const std::string& source() const { return source_; }
  /// Reads the meter.
  void sample(Duration now);
  /// Average over the last second: a step of an INA3221 is some 76 mW. Empty: no meter, or nothing
  /// could be read in that time.
  [[nodiscard]] std::optional<Watts> power() const;

 private:
  struct Reading {
    Duration at{};
    double value{};  ///< W of a rail; J since the start of counters.
  };
  [[nodiscard]] std::optional<double> counted_j();

  const LinuxSystem& system_;
  std::string source_{};
  std::optional<PowerRail> rail_{};
  std::vector<EnergyCounter> counters_{};
  std::vector<long long> last_uj_{};
  double total_j_{};
  std::deque<Reading> readings_{};
};

/// By the names of rails: VDD_SYS_CPU, VDD_SYS_GPU, VDD_SYS_DDR, VDD_SYS_SOC on a Jetson TX2. A
/// rail whose name tells of several parts (VDD_CPU_GPU_CV) counts for none of them.
[[nodiscard]] RailPower power_by_rail(const LinuxSystem& system,
                                      const std::vector<PowerRail>& rails);

/// The zone that is closest to losing clocks.
struct Heat {
  std::string zone{};
  double temperature_c{};
  std::optional<double> trip_c{};
};

/// The zone with a passive trip that is closest to it; without any such zone, the hottest. Empty:
/// no zone can be read.
[[nodiscard]] std::optional<Heat> closest_heat(const LinuxSystem& system,
                                               const std::vector<ThermalZone>& zones,
                                               const BoardFile& board);

}  // namespace flyball
