// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What is known on board before take-off and does not change in flight.

#include "flyball/flight/flight_settings.h"
#include "flyball/runtime/geometry.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/platform.h"
#include "flyball/runtime/speed_zone.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

inline constexpr double slow_m_s = 1.0;  ///< In narrow passages and rooms.

/// What is declared to the vehicle of the place that it flies in. Nothing else of the true world is
/// known on board.
struct Site {
  std::string place{};  ///< Its name, for messages.
  Aabb bounds_W{};
  std::vector<SpeedZone> zones{};
  Vec3 start_W{Vec3::Zero()};  ///< On the ground.
  Vec3 goal_W{Vec3::Zero()};
  /// No obstacle is closer to the vertical lines over start and goal, up to `clear_height_m` or to
  /// the top of `bounds_W`. Who gives the site vouches for it: no camera looks there before
  /// take-off.
  double start_clear_m{1.0};
  double goal_clear_m{1.0};
  double clear_height_m{2.5};
  double cruise_height_m{};
  double ground_z_m{};
  std::optional<double> open_above_m{};  ///< Nothing reaches higher above the ground.
  Aabb volume_W{};                       ///< To be explored, if anything is.
};

/// The same for every node, and constant while the graph runs.
struct Brief {
  FlightSettings settings{};
  Site site{};
  /// What is known of the computer; never null. Owners: the brief, and whoever set up the mission.
  std::shared_ptr<const Platform> platform{};
  Cylinder body{};      ///< Of the airframe.
  TrackingTube tube{};  ///< How far the vehicle may be from its reference.
  /// False when the graph has no map. Then space is free where the site is declared clear and
  /// nowhere else, at any distance.
  bool maps_obstacles{true};

  /// Whether the localizer takes images, so that the place is known from frame to frame only.
  bool sees_its_place{};
  /// Whether the flight controller alone corrects errors of the place, because set-points are
  /// carried over into its frame (`OdometryFrame`). A second correction beside its loops is
  /// unstable: an ArduCopter swayed by 4 m along its path.
  bool leaves_errors_to_controller{};

  /// The body with its tracking tube at a speed.
  [[nodiscard]] Cylinder body_at(double speed_m_s) const;
  /// The body with its tube in a narrow passage. Nothing is planned, checked or flown with less
  /// room.
  [[nodiscard]] Cylinder narrow_body() const { return body_at(slow_m_s); }
  /// The vehicle has come to where its reference stands when it is this near to it.
  [[nodiscard]] double arrival_error_m() const;
};

}  // namespace flyball
