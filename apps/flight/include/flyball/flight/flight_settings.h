// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a vehicle is told before it takes off: the limits of its mission, its sensors, and which
/// kernels fly it with which settings. A scenario file is one way to write it down.

#include "flyball/kernels/explorer.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/parameters.h"

#include <cstdint>
#include <map>
#include <string>

namespace flyball {

struct MissionSettings {
  std::string workload{"package_delivery"};
  double time_limit_s{1800.0};
  double plan_time_limit_s{
      90.0};  ///< Standing without a path for longer ends the mission: `no_plan`.
  double max_speed_m_s{10.0};
  double max_acceleration_m_s2{6.0};  ///< MAVBench: a in eq. 2.
  /// At the end of a path this near to it the goal is reached; a path that ends farther away is
  /// replanned. MAVBench has 3 m; a parcel needs less.
  double goal_tolerance_m{0.3};
};

/// Parameters of one kernel, as it declares them.
using ParameterValues = std::map<std::string, ParameterValue>;

struct KernelSettings {
  std::string point_cloud{"depth_to_points"};
  ParameterValues point_cloud_parameters{};
  std::string mapper{"octomap"};
  ParameterValues mapper_parameters{};
  std::string collision_check{"swept_cylinder"};
  ParameterValues collision_check_parameters{};
  std::string planner{"rrt_connect"};
  ParameterValues planner_parameters{};
  std::string smoother{"minimum_snap"};
  ParameterValues smoother_parameters{};
  std::string path_tracker{"feedforward_pd"};
  ParameterValues path_tracker_parameters{};
  std::string localizer{"truth"};
  ParameterValues localizer_parameters{};
  std::string coverage{"lawnmower"};
  ParameterValues coverage_parameters{};
  std::string explorer{"nbvp"};
  ParameterValues explorer_parameters{};
  std::string detector{"hog"};
  ParameterValues detector_parameters{};
  std::string tracker{"kcf"};
  ParameterValues tracker_parameters{};
  bool slam_load{
      true};  ///< Charge the paper's SLAM time per frame beside a localizer that needs none.
};

/// Knobs that exist only where the mission asks for them.
struct KnobChoices {
  std::string planner_kinds{"none"};   ///< Planners that `planner.kind` may put in the place of
                                       ///< `kernels.planner`: names with commas, or none.
  std::string detector_kinds{"none"};  ///< The same for `detector.kind`.
  bool camera_rate{};                  ///< Whether there is `camera.rate_hz`.
  bool localizer_rate{};               ///< Whether there is `localizer.rate_hz`.
};

/// Which nodes run on an edge computer at the start: 0 on board, 1 on the edge. A knob of the same
/// name moves each of them in flight.
struct OffloadSettings {
  int plan{};
  int map{};
  int detect{};
  int explore{};
};

struct MapSettings {
  double resolution_m{0.15};  ///< Default of the knob; a policy sets it in flight.
  double range_m{7.0};
  double rate_hz{20.0};
};

struct PlannerSettings {
  /// Most iterations of one search. More would be spent on a map that is seconds old; a new search
  /// on the newest map is worth more. The first of several takes fewer (`plan_with_tubes`).
  int budget{4000};
  /// A goal farther away is approached through intermediate places; 0: it is planned to at once.
  double horizon_m{};
};

/// What the workload `scanning` surveys: a rectangle in the middle of the world's bounds.
struct ScanSettings {
  double length_m{100.0};  ///< Eastwards, along the lanes. MAVBench: 100 x 100 m, 5 lanes.
  double width_m{100.0};   ///< Northwards, across them.
  int lanes{5};
  double height_m{15.0};          ///< Of flight, above the ground.
  double picture_rate_hz{2.0};    ///< Of the camera that looks down.
  double coverage_percent{95.0};  ///< Seeing less of the area than this is `incomplete`.
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
  double coast_s{3.0};            ///< How long an unseen person is followed by prediction.
  double search_rate_rad_s{0.8};  ///< Turn rate of the search after that; 0: the vehicle hovers.
  int lost_after_detections{20};  ///< Detections in a row without the person: they are lost.
  double success_s{60.0};         ///< Tracking for less time is a failure.
  double limit_s{120.0};          ///< Tracking for so long ends the mission (`is_censored`).
};

/// When the workload `search_and_rescue` believes that it has found somebody.
struct SearchSettings {
  int sightings{2};      ///< How many sightings must agree.
  double within_m{1.0};  ///< They must lie this close to each other, along the ground.
  double apart_m{0.25};  ///< They must be made from places at least this far apart.
};

/// Settings of the workload `watch`.
struct WatchSettings {
  double time_s{60.0};  ///< How long it watches.
  double height_m{};    ///< Height of the hover; 0: the vehicle stands with its rotors off.
  bool at_goal{};  ///< It stands at the goal, and flies there and back; otherwise at the start.
  double longest_s{2.0};  ///< A longer time between two maps is a failure.
};

struct GovernorSettings {
  std::string policy{"fixed_fine"};  ///< A preset, or a policy with its default parameters.
  double period_s{0.25};
};

struct FlightSettings {
  std::string name{"unnamed"};  ///< Of the mission, for messages.
  std::uint64_t seed{1};        ///< Of every random draw on board.
  MissionSettings mission{};
  /// How much later than its reference the vehicle brakes.
  Duration brake_lag{GuardSettings{}.brake_lag};
  DepthCameraSpec camera{};
  /// Standard deviation of a GPS fix, level [m]; 0 where another localizer is flown with.
  double fix_error_m{};
  KernelSettings kernels{};
  KnobChoices knobs{};
  bool has_edge{};  ///< Whether there is an edge computer to which nodes may move.
  MapSettings map{};
  PlannerSettings planner{};
  ScanSettings scan{};
  ExploreSettings explore{};
  DetectorSettings detector{};
  PhotographySettings photography{};
  SearchSettings search{};
  WatchSettings watch{};
  GovernorSettings governor{};
};

/// The guard that watches over this flight.
[[nodiscard]] GuardSettings guard_settings(const FlightSettings& settings);
/// Whose price the map's work has on the platform: the mapper's own, or that of the kernel that its
/// parameter `cost_of` names.
[[nodiscard]] std::string mapper_cost(const KernelSettings& kernels);
/// Whose price a detection has on the platform.
[[nodiscard]] std::string detector_cost(const FlightSettings& settings);
/// What a platform calls the work on one frame of a localizer that takes images:
/// `visual_slam_frames`.
[[nodiscard]] std::string frame_cost(const std::string& localizer);

}  // namespace flyball
