// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the nodes of one mission use: the vehicle's topics, the brief, knobs, kernels and the
/// record.

#include "flyball/flight/flight_settings.h"
#include "flyball/flight/mission_end.h"
#include "flyball/flight/perception/localization_watch.h"
#include "flyball/flight/perception/view.h"
#include "flyball/kernels/collision_check.h"
#include "flyball/kernels/coverage_planner.h"
#include "flyball/kernels/detector.h"
#include "flyball/kernels/explorer.h"
#include "flyball/kernels/localizer.h"
#include "flyball/kernels/mapper.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/kernels/path_tracker.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/kernels/smoother.h"
#include "flyball/kernels/tracker.h"
#include "flyball/runtime/gimbal.h"
#include "flyball/runtime/graph.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/platform.h"
#include "flyball/runtime/recorder.h"
#include "flyball/runtime/speed_zone.h"

#include <memory>
#include <optional>
#include <vector>

namespace flyball {

inline constexpr double slow_m_s = 1.0;  ///< In narrow passages and rooms.

/// What the scenario declares to the vehicle before take-off. Nothing else of the true world is
/// known on board.
struct MissionBrief {
  std::string place{};  ///< Its name, for messages.
  Aabb bounds_W{};
  std::vector<SpeedZone> zones{};
  Vec3 start_W{Vec3::Zero()};  ///< On the ground; clear within 1 m up to 2.5 m, as is the goal.
  Vec3 goal_W{Vec3::Zero()};
  double cruise_height_m{};
  double ground_z_m{};
  std::optional<double> open_above_m{};  ///< Nothing reaches higher above the ground.
  Aabb volume_W{};                       ///< To be explored, if anything is.
};

struct FlightCommand {
  enum class Kind : std::uint8_t { take_off, land, hold, release_payload };
  Kind kind{Kind::hold};
  double height_m{};
};

/// What the flight controller reports.
struct FlightStatus {
  bool airborne{};
  bool manoeuvre_done{};  ///< Take-off or landing.
};

/// The topics between the companion computer and the vehicle.
struct VehicleTopics {
  Topic<DepthFrame> depth;
  Topic<NavigationSample> navigation;
  Topic<FlightStatus> status;
  Topic<Setpoint> setpoint;
  Topic<FlightCommand> command;
  Topic<ColourFrame> colour{};         ///< These three only where the workload looks for people.
  Topic<ColourFrame> colour_buffer{};  ///< The same frames, kept until somebody takes them.
  Topic<GimbalAngles> gimbal{};        ///< Commanded angles.
  /// Of a simulator, before each navigation sample, where the localizer asks for it.
  std::optional<Topic<TruePose>> true_pose{};
};

struct MissionKernels {
  std::unique_ptr<PointCloudBuilder> point_cloud;
  std::unique_ptr<Mapper> mapper;
  std::unique_ptr<CollisionChecker> collision_check;
  std::unique_ptr<PathPlanner> planner;
  std::unique_ptr<Smoother> smoother;
  std::unique_ptr<PathTracker> path_tracker;
  std::unique_ptr<Localizer> localizer;
  std::unique_ptr<CoveragePlanner> coverage;
  std::unique_ptr<Explorer> explorer;
  std::unique_ptr<Detector> detector;         ///< These three only where the workload
  std::unique_ptr<Tracker> buffered_tracker;  ///< looks for people.
  std::unique_ptr<Tracker> real_time_tracker;
};

/// What is on board.
struct MissionEquipment {
  Cylinder body{};  ///< Of the airframe.
  KnobSettings knobs{};
  MissionKernels kernels{};
  bool has_rgb_camera{};  ///< Through the lens of the depth camera, for a localizer that needs it.
};

/// The announcement of a map that was published.
struct MapRevision {
  std::uint64_t number{};
  MissionTime captured{};  ///< Of the newest frame in it.
  MissionTime published{};
  double resolution_m{};
};

/// Counters for the summary.
struct MissionCounters {
  int replans{};
  int planner_failures_in_row{};
  std::uint64_t bound_overruns{};
  std::vector<double> budget_use{};  ///< Latency over its bound, for each published map.
  std::vector<double> latency_s{};   ///< Sensor to command, for each map revision that was used.
};

/// What the governor's fallback demands of the path follower.
struct FlightRestraint {
  double bound_factor{1.0};  ///< Of the bound on latency.
  bool must_hover{};
};

class MissionContext {
 public:
  /// Platform and recorder outlive the context.
  MissionContext(FlightSettings settings,
                 const Platform& platform,
                 Recorder& recorder,
                 MissionBrief brief,
                 MissionEquipment equipment);

  [[nodiscard]] const OccupancyView& map() const { return kernels.mapper->view(); }
  /// Slowest zone that contains `p_W`, and the knob's limit.
  [[nodiscard]] double speed_limit_m_s(const Vec3& p_W) const;
  /// The body with its tracking tube at a speed.
  [[nodiscard]] Cylinder body_at(double speed_m_s) const;
  /// The body with its tube in a narrow passage. Nothing is planned, checked or flown with less
  /// room.
  [[nodiscard]] Cylinder narrow_body() const { return body_at(slow_m_s); }
  void event(MissionTime at, const std::string& what);
  /// Ends the mission; the first end counts.
  void finish(MissionTime at, MissionStatus status, MissionFailure failure);
  [[nodiscard]] bool is_over() const { return status_.has_value(); }
  [[nodiscard]] MissionStatus status() const {
    return status_.value_or(MissionStatus::interrupted);
  }
  [[nodiscard]] MissionFailure failure() const { return failure_; }

  const FlightSettings settings;
  const Platform& platform;
  const MissionBrief brief;
  const Cylinder body;
  TrackingTube tube{};  ///< A workload may widen it before the flight.
  /// False when the graph has no map. Then space is free where the brief declares it clear and
  /// nowhere else, at any distance.
  bool maps_obstacles{true};
  KnobSettings knobs;
  OperatingPoint computer;  ///< Clock and cores in force, which a hot board grants less of.
  MissionKernels kernels;
  Recorder& recorder;
  LocalizationWatch localization{};
  const bool has_rgb_camera;          ///< Through the lens of the depth camera.
  std::optional<Topic<View>> view{};  ///< What it sees.
  MissionCounters counters{};
  MissionPhase phase{MissionPhase::wait};
  Vec3 goal_now_W{Vec3::Zero()};  ///< At cruise height.
  FlightRestraint restraint{};

 private:
  std::optional<MissionStatus> status_{};
  MissionFailure failure_{MissionFailure::none};
};

/// What a vehicle serves beside depth camera, navigation and flight controller.
struct VehicleExtras {
  bool colour_camera{};
  bool true_pose{};
};

/// Topics that the vehicle serves.
[[nodiscard]] VehicleTopics add_vehicle_topics(Graph& graph, const VehicleExtras& extras = {});

}  // namespace flyball
