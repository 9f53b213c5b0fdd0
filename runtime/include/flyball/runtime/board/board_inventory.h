// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a Linux system has of what a governor needs: clocks, cores, thermal zones, power rails,
/// energy counters, and the daemons that would fight over them.

#include "flyball/runtime/board/linux_system.h"
#include "flyball/runtime/units.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// One group of cores with one clock: a folder of cpufreq.
struct CpufreqPolicy {
  std::string folder{};
  std::vector<int> cpus{};  ///< All that share the clock, ascending; some may be off-line.
  std::string driver{};
  std::string governor{};                ///< As found.
  std::vector<std::string> governors{};  ///< That may be chosen.
  std::vector<Hertz> frequencies{};      ///< Ascending; empty: the driver takes any in its range.
  Hertz lowest{};                        ///< Of the hardware.
  Hertz highest{};
  Hertz min{};  ///< Limits of the software, as found.
  Hertz max{};

  /// Whether a clock can be written as such. Otherwise both limits are moved to it.
  [[nodiscard]] bool has_set_speed() const;
};

/// A core that is off-line has no cpufreq files: that is a state, not an error.
struct BoardCore {
  int id{};
  bool is_online{};
  bool has_switch{};  ///< There is a file `online`.
};

struct ThermalZone {
  std::string folder{};
  std::string type{};
  std::optional<double> temperature_c{};  ///< Empty: the sensor is disconnected.
  std::optional<double> trip_c{};         ///< Lowest passive trip: from there clocks are taken.
};

/// A channel of a power monitor (INA3221 and others).
struct PowerRail {
  std::string label{};
  std::string power_file{};     ///< Empty: watts are `voltage_file` times `current_file`, mV, mA.
  double watts_per_unit{1e-3};  ///< Of `power_file`.
  std::string voltage_file{};
  std::string current_file{};
};

/// A domain of RAPL (powercap). Counts microjoules and wraps.
struct EnergyCounter {
  std::string name{};  ///< psys: the whole machine; package-0: a processor without its board.
  std::string file{};
  long long range_uj{};  ///< The count after which it starts at 0 again.
  bool is_readable{};    ///< Since 2020 kernels let only root read it.
};

/// A daemon that sets clocks too.
struct Rival {
  int pid{};
  std::string name{};
  std::string advice{};
};

struct BoardInventory {
  std::string model{};  ///< Of the device tree, or of the firmware (DMI).
  std::string kernel{};
  std::vector<CpufreqPolicy> policies{};
  std::vector<BoardCore> cores{};  ///< Present ones, ascending.
  std::vector<ThermalZone> zones{};
  std::vector<PowerRail> rails{};
  std::vector<EnergyCounter> counters{};
  std::vector<Rival> rivals{};
};

/// Looks at everything once; writes nothing. What is missing is left out.
/// @cost  Some hundred files: tens of milliseconds on a small board; set-up only.
[[nodiscard]] BoardInventory discover_board(const LinuxSystem& system);

/// Of `discover_board`, alone, because they may start at any time.
/// @cost  One file for each process of the system.
[[nodiscard]] std::vector<Rival> find_rivals(const LinuxSystem& system);

/// One file; empty: disconnected, or not readable. A disconnected zone reads -256 degrees
/// (jetson_stats issue 800).
[[nodiscard]] std::optional<double> zone_temperature_c(const LinuxSystem& system,
                                                       const std::string& folder);

/// Watts of one rail now; empty: it cannot be read.
[[nodiscard]] std::optional<Watts> rail_power(const LinuxSystem& system, const PowerRail& rail);

}  // namespace flyball
