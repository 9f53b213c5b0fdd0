// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether the localizer still knows where the vehicle is, and what the vehicle does when it is
/// lost.

#include "flyball/flight/perception/localization_nodes.h"
#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/messages.h"

#include <deque>
#include <optional>

namespace flyball {

class LocalizationWatch {
 public:
  /// The camera localizer has answered for a frame, with a pose or without one.
  void fixed(MissionTime now, const VisualFix& fix);
  /// Nothing was answered until now: for two seconds without an answer, as after the camera has
  /// failed, nobody knows either where the vehicle is.
  void waited(MissionTime now);
  [[nodiscard]] bool is_lost() const { return lost_since_.has_value(); }
  /// Lost, or searching in vain, for longer than turning and flying back take: the mission gives
  /// up.
  [[nodiscard]] bool has_given_up(MissionTime now) const;

  /// Remembers the track of the vehicle; call it with every estimate while it is not lost.
  void passed(const PoseEstimate& estimate);

  /// The set-point while lost: the vehicle stops at its last known place, looks to both sides,
  /// flies back three metres along its own track, and looks again. Positions are the flight
  /// controller's, which holds them without the companion computer. The search begins with the
  /// first call, at the height of that time: the vehicle may have been lost on the ground, or in a
  /// climb.
  [[nodiscard]] std::optional<Setpoint> search(MissionTime now, double height_W_m);

  /// What the others are told.
  /// @param may_search  Not while the flight controller takes off or lands.
  [[nodiscard]] LocalizationStatus status(MissionTime now, double height_W_m, bool may_search);

 private:
  struct Search {
    MissionTime since{};
    double height_W_m{};
  };
  void lose(MissionTime now);
  /// The estimate from so many metres of track ago, or the oldest one that is remembered.
  [[nodiscard]] const PoseEstimate& passed_before(double path_m) const;

  std::deque<PoseEstimate> trail_{};  ///< A decimetre apart, newest last.
  std::optional<MissionTime> answered_{};
  std::optional<MissionTime> lost_since_{};
  std::optional<Search> search_{};
  int times_lost_{};
  double lost_s_{};
};

}  // namespace flyball
