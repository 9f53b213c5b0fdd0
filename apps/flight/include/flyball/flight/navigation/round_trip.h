// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// To the site's goal and back, with a landing at each end.

#include "flyball/flight/legs.h"
#include "flyball/flight/navigation/navigation_nodes.h"

#include <memory>

namespace flyball {

/// Takes off, flies to the goal and lands there; when it is told to, it does the same on the way
/// home. The mission's node owns one and asks it ten times a second.
class RoundTrip {
 public:
  /// Where the vehicle has just landed.
  enum class Landed : std::uint8_t { no, at_goal, at_home };

  /// @param perception  Of the graph to which `guidance` belongs.
  RoundTrip(const FlightParts& parts, const PerceptionTopics& perception, const Guidance& guidance)
      : brief_{parts.brief},
        mission_{parts.mission},
        perception_{perception},
        guidance_{guidance},
        legs_{parts.vehicle, parts.mission} {}

  /// What the node that calls the members below has to declare.
  void declare(NodeSpec& spec) const;
  [[nodiscard]] const Legs& legs() const { return legs_; }
  /// Flies on, and says once when the vehicle has landed. Then it stands until `go_home`.
  Landed step(JobContext& job, const PoseEstimate& pose);
  /// @pre `step` has said `at_goal`.
  void go_home();
  [[nodiscard]] bool is_flying() const { return stage_ == Stage::flying; }
  /// How much nearer to its two goals this place is than the start, as the crow flies [m]. A detour
  /// is no progress, and neither is the way back from one a loss.
  [[nodiscard]] double nearer_m(const Vec3& p_W);

 private:
  enum class Leg : std::uint8_t { out, back };
  enum class Stage : std::uint8_t { ready, climbing, flying, landing, landed };

  [[nodiscard]] bool has_arrived(JobContext& job) const;
  [[nodiscard]] Vec3 above(const Vec3& ground_W) const;
  [[nodiscard]] bool is_at_goal() const;
  [[nodiscard]] const Vec3& begin_W() const;
  [[nodiscard]] const Vec3& end_W() const;
  void take_off(JobContext& job, const PoseEstimate& pose);
  void depart(JobContext& job);
  void land(JobContext& job);

  std::shared_ptr<const Brief> brief_;  ///< Owners: all nodes.
  MissionTopics mission_;
  PerceptionTopics perception_;
  Guidance guidance_;
  Legs legs_;
  Leg leg_{Leg::out};
  Stage stage_{Stage::ready};
  double nearer_m_{};  ///< To the goals of both legs together.
};

}  // namespace flyball
