// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One mission, completely described: what `flyball run` reads, and what each record begins with.

#include "flyball/flight/flight_settings.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"
#include "flyball/scenario/plugins.h"
#include "flyball/sim/barometer.h"
#include "flyball/sim/colour_camera.h"
#include "flyball/sim/gps.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace flyball {

struct WorldSettings {
  std::string generator{"empty"};
  std::map<std::string, ParameterValue> parameters{};
};

struct VehicleSettings {
  std::string airframe{"matrice_100"};
  double payload_kg{0.5};
  double tracking_error_m{0.02};  ///< What the simulated flight controller keeps at rest.
  double brake_lag_s{0.1};        ///< The same controller's, .069 s at most.
  double physics_step_s{0.001};
  double comparison_step_s{};  ///< Instead, where many flights are compared; 0: the same.
  double battery_charge{1.0};  ///< At the start, 0..1.
  std::string rotor_power{"regression"};  ///< `regression` (eq. 1) or `thrust`.
  double drive_efficiency{
      0.70};  ///< Of the thrust model: 176 W shaft / 251.7 W electrical at hover.
  double wind_east_m_s{};
  double wind_north_m_s{};
  double gust_wind_m_s{};  ///< Wind at 20 ft whose gusts (Dryden, MIL-F-8785C) blow; 0: none.
};

struct PlatformSettings {
  std::string name{"jetson_tx2"};
  int cores{4};
  double frequency_hz{2.0352e9};
  double start_temperature_c{};  ///< 0: as warm as it is after it has idled for long.
};

/// A computer that is not on board, at the other end of a radio link.
struct EdgeSettings {
  std::string platform{"none"};     ///< Whose prices count there, at its highest clock with all its
                                    ///< cores; none: there is no such computer.
  double speed_factor{1.0};         ///< It is so many times faster than that.
  double bandwidth_mbit_s{1000.0};  ///< The paper's 1 Gb/s.
  double latency_s{0.001};          ///< One way. An estimate for a wireless network on site.
  double jitter_s{};                ///< A message takes up to so much longer.
  double loss{};                    ///< Share of packets.
  double timeout_s{0.2};            ///< Least time-out of TCP in Linux (TCP_RTO_MIN).
  /// A wireless card with three antennas that sends: 2.1 W, measured (Halperin et al., Demystifying
  /// 802.11n power consumption, HotPower 2010).
  double radio_send_w{2.1};
  double radio_receive_w{1.6};  ///< An estimate: three quarters of sending.
  double radio_idle_w{0.8};     ///< An estimate for one antenna that listens.
};

/// What guards the messages on board against soft errors.
struct FaultSettings {
  std::string detector{"none"};  ///< `none`, `range`, `rate` or `both`: see `Plausibility`.
};

/// Something that happens to the companion computer in flight; which members count is a matter of
/// the kind.
struct ComputerEvent {
  std::string kind{};           ///< `slowdown`, `co_runner`, `cooling` or `bit_flip`.
  double at_s{};                ///< Mission time.
  double until_s{};             ///< 0: it lasts.
  double factor{1.0};           ///< Slowdown: kernels take so many times what the file says.
  std::string kernels{"all"};   ///< Slowdown: these only, with commas between them.
  double cores{};               ///< Co-runner: kept busy.
  double memory_share{};        ///< Co-runner: of the memory's bandwidth.
  double resistance_k_w{8.0};   ///< Cooling: from the computer to the air.
  double ambient_c{40.0};       ///< Cooling: of the air.
  std::string topic{};          ///< Bit flip: in the next message here.
  std::string variable{"any"};  ///< Bit flip: in a number of this name, or in any.
  double draw{};                ///< Bit flip: with the seed, settles which number and which bit.
};

struct Scenario {
  std::string name{"unnamed"};
  std::uint64_t seed{1};
  Plugins plugins{};  ///< What the names below stand for; no setting.
  MissionSettings mission{};
  WorldSettings world{};
  VehicleSettings vehicle{};
  DepthCameraSpec camera{};
  ColourCameraSpec colour_camera{};
  GpsSpec gps{};
  BarometerSpec barometer{};
  KernelSettings kernels{};
  KnobChoices knobs{};
  MapSettings map{};
  PlannerSettings planner{};
  ScanSettings scan{};
  ExploreSettings explore{};
  DetectorSettings detector{};
  PhotographySettings photography{};
  SearchSettings search{};
  WatchSettings watch{};
  PlatformSettings platform{};
  EdgeSettings edge{};
  OffloadSettings offload{};
  FaultSettings faults{};
  GovernorSettings governor{};
  std::vector<ComputerEvent> events{};
};

/// The part of a scenario that the vehicle knows.
[[nodiscard]] FlightSettings flight_settings(const Scenario& scenario);

/// A value of the configuration as `flyball config` prints it.
struct ConfigEntry {
  std::string key;  ///< `map.range_m`
  std::string value;
  std::string fallback;
  std::string origin;  ///< `default`, the file's name with line, or `--set`.
  std::string description;
};

struct LoadedScenario {
  Scenario scenario;
  std::vector<ConfigEntry> entries;
};

/// Reads a scenario and applies `KEY=VALUE` overrides on top.
///
/// @param name_or_path  `delivery_forest` (shipped) or a path to a .toml file.
/// @param plugins       What the scenario may name; by default what is compiled in.
/// @return              Every violation at once: unknown keys, wrong types and units, values out of
///                      range (both sides of the inequality), each as one sentence.
[[nodiscard]] std::variant<LoadedScenario, std::vector<Error>> load_scenario(
    const std::string& name_or_path,
    const std::vector<std::string>& overrides,
    const Plugins& plugins = {});

/// The scenario as a .toml file that `load_scenario` reads back to the same values.
[[nodiscard]] std::string to_toml(const Scenario& scenario);

}  // namespace flyball
