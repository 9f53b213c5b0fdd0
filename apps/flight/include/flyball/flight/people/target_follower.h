// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Keeps a person in the middle of the image and at a constant distance: boxes of detector and
/// tracker in, set-points for vehicle and gimbal out.

#include "flyball/flight/people/target_nodes.h"
#include "flyball/runtime/gimbal.h"
#include "flyball/runtime/messages.h"

namespace flyball {

struct FollowSettings {
  double distance_m{7.0};  ///< Along the ground.
  double person_height_m{1.75};
  double height_m{4.5};           ///< Of the vehicle above the person's feet.
  double ground_z_m{};            ///< Height in the world on which people stand.
  double coast_s{3.0};            ///< How long an unseen person is followed by prediction.
  double search_rate_rad_s{0.8};  ///< Turn rate of the search after that; 0: the vehicle hovers.
  double max_speed_m_s{6.0};
  double max_acceleration_m_s2{3.0};
};

/// A PID controller. Its output is clamped, and the integral does not grow while it is.
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

/// Estimates place and velocity of the person (alpha-beta filter over the boxes) and keeps its
/// distance from there. While the person is out of view the prediction goes straight on, because
/// people come out again behind a tree. When they do not, the vehicle flies near the predicted
/// place, which opens the view behind the tree, and turns round there, first to the side to which
/// the person went.
class TargetFollower {
 public:
  explicit TargetFollower(const FollowSettings& settings);

  /// The pose from which following begins.
  void start(const PoseEstimate& pose);
  /// A tracker's measurement. It is ignored without a box, when it is older than the last one, or
  /// when the person cannot be there, because trackers hold on to trees, too. `pose` is the pose at
  /// the capture.
  void tracked(const Target& target, const PoseEstimate& pose);
  /// A detector's measurement. A detection where the person cannot be counts only when it is
  /// repeated.
  void detected(const Target& target, const PoseEstimate& pose);
  /// @param limit_m_s  Of speed now, beside that of the settings; 0: the vehicle is to stand.
  [[nodiscard]] Setpoint tick(MissionTime now, Duration period, double limit_m_s);
  [[nodiscard]] const GimbalAngles& gimbal() const { return gimbal_; }

 private:
  struct Measurement {
    Vec3 place_W{Vec3::Zero()};
    MissionTime at{};
  };
  /// Empty for a measurement that is ignored.
  [[nodiscard]] std::optional<Measurement> measured(const Target& target,
                                                    const PoseEstimate& pose) const;
  [[nodiscard]] bool can_be_at(const Measurement& measured) const;
  [[nodiscard]] bool is_repeated(const Measurement& measured) const;
  void begin_at(const Measurement& measured);
  void believe(const Measurement& measured);
  [[nodiscard]] Vec3 follow(double age_s, double dt_s, Setpoint& setpoint);
  [[nodiscard]] Vec3 search(MissionTime now, double dt_s, Setpoint& setpoint);
  void face(const Vec3& place_W, double dt_s, Setpoint& setpoint);
  /// The predicted place of the person so long after they were last seen.
  [[nodiscard]] Vec3 foreseen(double after_s) const;
  void point_at(const Vec3& person_W);
  void steer(const Vec3& wish_W, double dt_s, Setpoint& setpoint);

  FollowSettings settings_;
  Pid distance_pid_;
  Pid yaw_pid_;
  GimbalAngles gimbal_{};
  std::optional<MissionTime> seen_{};  ///< Time of the estimate.
  Vec3 person_W_{Vec3::Zero()};        ///< Estimated middle of the person.
  Vec3 v_person_W_{Vec3::Zero()};
  Vec3 p_W_{Vec3::Zero()};  ///< Of the vehicle, as commanded.
  Vec3 v_W_{Vec3::Zero()};
  double yaw_rad_{};
  std::optional<Measurement> candidate_{};  ///< A detection that has not been repeated yet.
  double side_{1.0};  ///< Side to which the person goes, seen from the vehicle: 1 left, -1 right.
};

}  // namespace flyball
