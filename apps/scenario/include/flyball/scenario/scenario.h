// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One mission, completely described: what `flyball run` reads, and what each record begins with.

#include "flyball/kernels/explorer.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"
#include "flyball/sim/barometer.h"
#include "flyball/sim/colour_camera.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/gps.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace flyball {

struct MissionSettings {
  std::string workload{"package_delivery"};
  double time_limit_s{1800.0};
  double plan_time_limit_s{
      90.0};  ///< Standing without a path for longer ends the mission: `no_plan`.
  double max_speed_m_s{10.0};
  double max_acceleration_m_s2{6.0};  ///< MAVBench: a in eq. 2.
  double goal_tolerance_m{
      3.0};  ///< A path that ends farther from the goal is replanned (MAVBench).
};

struct WorldSettings {
  std::string generator{"empty"};
  std::map<std::string, ParameterValue> parameters{};
};

struct VehicleSettings {
  std::string airframe{"matrice_100"};
  double payload_kg{0.5};
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

struct KernelSettings {
  std::string point_cloud{"depth_to_points"};
  std::string mapper{"octomap"};
  std::map<std::string, ParameterValue> mapper_parameters{};  ///< As the mapper declares them.
  std::string collision_check{"swept_cylinder"};
  std::string planner{"rrt_connect"};
  std::string smoother{"minimum_snap"};
  std::string path_tracker{"feedforward_pd"};
  std::string localizer{"truth"};
  std::map<std::string, ParameterValue> localizer_parameters{};  ///< As the localizer declares.
  std::string coverage{"lawnmower"};
  std::string explorer{"nbvp"};
  std::string detector{"hog"};
  std::map<std::string, ParameterValue> detector_parameters{};  ///< As the detector declares them.
  std::string tracker{"kcf"};
  bool slam_load{
      true};  ///< Charge the paper's SLAM time per frame beside a localizer that needs none.
};

struct MapSettings {
  double resolution_m{0.15};  ///< Default of the knob; a policy sets it in flight.
  double range_m{7.0};
  double rate_hz{20.0};
};

struct PlannerSettings {
  /// Iterations per request. More would be spent on a map that is seconds old: a new request, with
  /// the newest map, is worth more.
  int budget{4000};
  /// A farther goal is approached through places on the way; 0: it is planned to at once.
  double horizon_m{};
};

/// What the workload `scanning` surveys: a rectangle in the middle of the world's bounds.
struct ScanSettings {
  double length_m{100.0};  ///< Eastwards, along the lanes. MAVBench: 100 x 100 m, 5 lanes.
  double width_m{100.0};   ///< Northwards, across them.
  int lanes{5};
  double height_m{15.0};          ///< Of flight, above the ground.
  double picture_rate_hz{2.0};    ///< Of the camera that looks down.
  double coverage_percent{95.0};  ///< Less of the area seen at the end: `incomplete`.
};

struct DetectorSettings {
  double scale{1.0};  ///< Default of the knob; a policy sets it in flight.
  /// Whose price a detection has on the modeled computer: `own`, or a kernel of the platform file.
  std::string cost_of{"own"};
  std::string models_folder{"shipped"};  ///< Looked in first for weights; see `flyball models`.
};

struct PhotographySettings {
  double distance_m{7.0};  ///< Kept to the person, along the ground.
  double person_height_m{1.75};
  double coast_s{3.0};  ///< So long the person is followed on where they should be, unseen.
  double search_rate_rad_s{0.8};  ///< Then the vehicle turns round for them; 0: it stands.
  int lost_after_detections{20};  ///< In a row without the person: the target is lost.
  double success_s{60.0};         ///< Tracked for less is a failure.
  double limit_s{120.0};          ///< Tracked for so long ends the mission: the record is censored.
};

/// What the workload `watch` does.
struct WatchSettings {
  double time_s{60.0};    ///< That it watches for.
  double height_m{};      ///< Where it hovers, above the ground; 0: it stands with its rotors off.
  double longest_s{2.0};  ///< Between two maps; a longer time without news is a failure.
};

struct PlatformSettings {
  std::string name{"jetson_tx2"};
  int cores{4};
  double frequency_hz{2.0352e9};
  double start_temperature_c{};  ///< 0: as warm as it is after it has idled for long.
};

/// Something that happens to the companion computer in flight; which members count is a matter of
/// the kind.
struct ComputerEvent {
  std::string kind{};          ///< `slowdown`, `co_runner` or `cooling`.
  double at_s{};               ///< Mission time.
  double until_s{};            ///< 0: it lasts.
  double factor{1.0};          ///< Slowdown: kernels take so many times what the file says.
  std::string kernels{"all"};  ///< Slowdown: these only, with commas between them.
  double cores{};              ///< Co-runner: kept busy.
  double memory_share{};       ///< Co-runner: of the memory's bandwidth.
  double resistance_k_w{8.0};  ///< Cooling: from the computer to the air.
  double ambient_c{40.0};      ///< Cooling: of the air.
};

struct GovernorSettings {
  std::string policy{"fixed_fine"};  ///< A preset, or a policy with its default parameters.
  double period_s{0.25};
};

struct Scenario {
  std::string name{"unnamed"};
  std::uint64_t seed{1};
  MissionSettings mission{};
  WorldSettings world{};
  VehicleSettings vehicle{};
  DepthCameraSpec camera{};
  ColourCameraSpec colour_camera{};
  GpsSpec gps{};
  BarometerSpec barometer{};
  KernelSettings kernels{};
  MapSettings map{};
  PlannerSettings planner{};
  ScanSettings scan{};
  ExploreSettings explore{};
  DetectorSettings detector{};
  PhotographySettings photography{};
  WatchSettings watch{};
  PlatformSettings platform{};
  GovernorSettings governor{};
  std::vector<ComputerEvent> events{};
};

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
/// @return              Every violation at once: unknown keys, wrong types and units, values out of
///                      range (both sides of the inequality), each as one sentence.
[[nodiscard]] std::variant<LoadedScenario, std::vector<Error>> load_scenario(
    const std::string& name_or_path, const std::vector<std::string>& overrides);

/// The scenario as a .toml file that `load_scenario` reads back to the same values.
[[nodiscard]] std::string to_toml(const Scenario& scenario);

}  // namespace flyball
