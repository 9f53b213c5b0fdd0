// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the autopilot says of itself and its vehicle.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/time.h"
#include "flyball/vehicles/vehicle_report.h"

#include "vehicles/autopilot_kind.h"
#include "vehicles/mavlink_messages.h"
#include "vehicles/ned_frames.h"
#include "vehicles/sender_clock.h"
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// How the vehicle moves, in our frames.
struct VehicleMotion {
  Pose X_WB{Pose::Identity()};
  Vec3 v_WB{Vec3::Zero()};
  Vec3 w_WB_B{Vec3::Zero()};  ///< Angular velocity in B [rad/s].
  Vec3 a_WB{Vec3::Zero()};    ///< From the last two velocities [m/s^2].
};

/// Listens to one autopilot: the first whose HEARTBEAT comes. A pose is as old as it is by the
/// autopilot's own clock. Where its estimate of the position jumps, the mission's world goes along:
/// the vehicle has not moved, and what its map shows around it still is where it was (as the frame
/// "odom" of REP 105, which is continuous and may drift).
class AutopilotTelemetry {
 public:
  void hear(const MavlinkFrame& frame, Duration now);
  /// Notices what has not come. Once the autopilot was heard, its silence is told once.
  void look(Duration now);
  /// Sentences for people since the last call: warnings of the autopilot, silence and its end.
  [[nodiscard]] std::vector<std::string> take_news();
  void tell(std::string sentence) { news_.push_back(std::move(sentence)); }

  /// Whether the message comes from it.
  [[nodiscard]] bool is_from_autopilot(const MavlinkFrame& frame) const;
  [[nodiscard]] std::uint8_t system() const { return system_; }
  /// Empty before its first HEARTBEAT; an error if it is one that cannot be flown.
  [[nodiscard]] const std::optional<Result<AutopilotKind>>& kind() const { return kind_; }

  [[nodiscard]] std::uint32_t mode() const { return heartbeat_.custom_mode; }
  [[nodiscard]] bool is_armed() const { return (heartbeat_.base_mode & mav::flag_armed) != 0; }
  /// Empty until it says so for the first time.
  [[nodiscard]] std::optional<bool> is_on_ground() const { return is_on_ground_; }

  /// Where it calls `at_N` what is `at_W` in the mission.
  void place(const LocalOrigin& origin) {
    origin_ = origin;
    is_placed_ = true;
  }
  [[nodiscard]] const LocalOrigin& origin() const { return origin_; }
  [[nodiscard]] bool has_position() const { return position_made_.has_value(); }
  [[nodiscard]] bool has_attitude() const { return attitude_made_.has_value(); }
  [[nodiscard]] Vec3 position_N() const { return p_N_; }
  /// Empty where nobody measures it, or has not said so for 2 s.
  [[nodiscard]] std::optional<ReportedBattery> battery(Duration now) const;
  /// Whether position and attitude are no older than .25 s.
  [[nodiscard]] bool is_fresh(Duration now) const;
  /// Now: position and attitude go on with their rates for the age of their messages, .25 s at
  /// most.
  [[nodiscard]] VehicleMotion motion(Duration now) const;

 private:
  void hear_heartbeat(const MavlinkFrame& frame, Duration now);
  void hear_position(const MavLocalPosition& position, Duration now);
  void follow_jump(const Vec3& p_N, const Vec3& v_N, double step_s);
  void hear_battery(const MavSystemStatus& status, Duration now);
  void hear_attitude(const MavAttitudeQuaternion& attitude, Duration now);
  void hear_text(const MavStatusText& text);
  void tell_of_sight(bool is_blind, Duration now);

  std::uint8_t system_{};
  std::optional<Result<AutopilotKind>> kind_{};
  MavHeartbeat heartbeat_{};
  std::optional<bool> is_on_ground_{};
  LocalOrigin origin_{};
  bool is_placed_{};
  Vec3 p_N_{Vec3::Zero()};
  Vec3 v_N_{Vec3::Zero()};
  Vec3 a_N_{Vec3::Zero()};
  std::uint32_t position_boot_ms_{};
  Eigen::Quaterniond q_ND_{Eigen::Quaterniond::Identity()};
  Vec3 w_D_{Vec3::Zero()};
  std::optional<Duration> heartbeat_heard_{};
  std::optional<ReportedBattery> battery_{};
  Duration battery_heard_{};
  SenderClock clock_{};
  std::optional<Duration> position_made_{};
  std::optional<Duration> attitude_made_{};
  bool is_silent_{};
  bool is_blind_{};             ///< No position comes,
  bool has_told_blind_{};       ///< and who flies has been told so,
  Duration next_blind_news_{};  ///< which is not told again before then.
  bool has_told_of_signature_{};
  std::string text_{};  ///< Pieces of a longer STATUSTEXT.
  std::uint16_t text_id_{};
  std::vector<std::string> news_{};
};

}  // namespace flyball
