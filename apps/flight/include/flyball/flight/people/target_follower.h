// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Keeps a person in the middle of the image and at a distance: image error and box size in,
/// set-points for vehicle and gimbal out.

#include "flyball/flight/people/target_nodes.h"
#include "flyball/runtime/gimbal.h"
#include "flyball/runtime/messages.h"

namespace flyball {

struct FollowSettings {
  double distance_m{7.0};  ///< Along the ground.
  double person_height_m{1.75};
  double height_m{4.5};           ///< Of the vehicle above the person's feet.
  double ground_z_m{};            ///< Where people stand, in the world.
  double coast_s{3.0};            ///< So long after somebody was last seen they are followed on.
  double search_rate_rad_s{0.8};  ///< Of turning round after that; 0: the vehicle stands.
  double max_speed_m_s{6.0};
  double max_acceleration_m_s2{3.0};
};

/// Output of a PID controller, clamped; the integral stands still while it is.
class Pid {
 public:
  struct Gains {
    double proportional{};
    double integral{};
    double derivative{};
    double limit{};
  };
  explicit Pid(const Gains& gains) : gains_{gains} {}
  double update(double error, double dt_s);
  void reset();

 private:
  Gains gains_;
  double integral_{};
  std::optional<double> last_{};
};

/// Believes where the person is and goes (alpha-beta filter over what the boxes say), and stays at
/// its distance from there. While nothing is seen the belief goes on straight ahead: people come
/// out again behind a tree. When they do not, the vehicle goes near to where they should be, which
/// opens the view behind a tree, and turns round there, first to the side on which they went.
class TargetFollower {
 public:
  explicit TargetFollower(const FollowSettings& settings);

  /// Where the flight goes on from.
  void start(const PoseEstimate& pose);
  /// A tracker's measurement. It says nothing without a box, when it is older than the last, or
  /// when it is not where the person can be: trackers hold on to trees, too. `pose` is that of its
  /// capture.
  void see(const Target& target, const PoseEstimate& pose);
  /// A detector's. Somebody where the person cannot be is a rumour; seen there twice, they count.
  void sight(const Target& target, const PoseEstimate& pose);
  [[nodiscard]] Setpoint tick(MissionTime now, Duration period);
  [[nodiscard]] const GimbalAngles& gimbal() const { return gimbal_; }

 private:
  struct Rumour {
    Vec3 place_W{Vec3::Zero()};
    MissionTime at{};
  };
  /// Empty for what says nothing.
  [[nodiscard]] std::optional<Rumour> measured(const Target& target,
                                               const PoseEstimate& pose) const;
  [[nodiscard]] bool can_be_at(const Rumour& measured) const;
  [[nodiscard]] bool is_said_again(const Rumour& measured) const;
  void begin_at(const Rumour& measured);
  void believe(const Rumour& measured);
  [[nodiscard]] Vec3 follow(double age_s, double dt_s, Setpoint& setpoint);
  [[nodiscard]] Vec3 search(MissionTime now, double dt_s, Setpoint& setpoint);
  void face(const Vec3& place_W, double dt_s, Setpoint& setpoint);
  /// Where the person is so long after they were last seen.
  [[nodiscard]] Vec3 foreseen(double after_s) const;
  void point_at(const Vec3& person_W);
  void steer(const Vec3& wish_W, double dt_s, Setpoint& setpoint);

  FollowSettings settings_;
  Pid distance_pid_;
  Pid yaw_pid_;
  GimbalAngles gimbal_{};
  std::optional<MissionTime> seen_{};  ///< Time of the belief.
  Vec3 person_W_{Vec3::Zero()};        ///< Belief: the middle of the person.
  Vec3 v_person_W_{Vec3::Zero()};
  Vec3 p_W_{Vec3::Zero()};  ///< Of the vehicle, as commanded.
  Vec3 v_W_{Vec3::Zero()};
  double yaw_rad_{};
  std::optional<Rumour> rumour_{};
  double side_{1.0};  ///< To which the person goes, seen from the vehicle: 1 left, -1 right.
};

}  // namespace flyball
