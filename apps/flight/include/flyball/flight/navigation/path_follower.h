// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Moves the reference along the committed path, as fast as map, latency and guard allow.

#include "flyball/flight/mission_topics.h"
#include "flyball/flight/navigation/speed_profile.h"
#include "flyball/kernels/path_tracker.h"
#include "flyball/runtime/guard.h"

#include <array>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace flyball {

/// A bound that is longer is not told: at a minute the vehicle barely moves, and its guard stops it
/// before what is unknown in any case.
inline constexpr Duration longest_latency_bound = std::chrono::seconds{60};

/// Where the vehicle is relative to its reference.
struct TrackingError {
  double size_m{};
  double across_m{};  ///< Horizontal and perpendicular to the path.
  double height_m{};  ///< Upwards.
  double ahead_m{};   ///< Along the path.
};

/// The tube around the path grows with speed, so a passage can be too narrow for cruise and wide
/// enough for a crawl. Three tiers of speed: narrow passages, near obstacles, and the knob's
/// largest.
inline constexpr std::size_t speed_tiers = 3;
using TierDistances = std::array<double, speed_tiers>;

/// The largest speed of each tier [m/s], slowest first.
[[nodiscard]] TierDistances tier_speeds_m_s(const KnobsInForce& knobs);

/// Arc length up to which a path is known to be free for the body's tube at each tier's speed.
/// @param s_m  Where the search begins, as far as the map's range and a little.
[[nodiscard]] TierDistances known_free_until_m(const OccupancyView& map,
                                               const Path& path,
                                               double s_m,
                                               const Brief& brief,
                                               const KnobsInForce& knobs);

/// Known-free distance is used in two ways that must not be mixed, so that latency counts only
/// once. The cruise set-point measures it from the capture pose of the newest frame and reacts
/// within delta (eq. 2). The guard measures it from the present place and reacts within t_b.
class PathFollower {
 public:
  /// Until `set_knobs` it knows no knobs and must not be asked to move.
  explicit PathFollower(std::shared_ptr<const Brief> brief);

  /// The snapshot in force from now on.
  void set_knobs(std::shared_ptr<const KnobsInForce> knobs) { knobs_ = std::move(knobs); }

  /// Hovers at a place; forgets the path.
  void hover_at(const Vec3& p_W, double yaw_rad);
  /// Replaces the committed path beyond `splice_m` by `tail`, which begins there.
  ///
  /// @return  False when nothing has changed, because the reference has passed the splice or is too
  ///          fast for the curves behind it.
  [[nodiscard]] bool adopt(const Path& tail, double splice_m);
  /// The reference stops at this arc length, even if the path goes on. A later call may move the
  /// stop.
  void commit_stop(double s_m);

  /// At the path's end, shortly before it, or hovering, the camera turns to this heading.
  void face(std::optional<double> yaw_rad) { face_yaw_rad_ = yaw_rad; }

  /// Brakes and stays where it is, until told otherwise.
  void stop(bool must) { must_stop_ = must; }
  /// While the vehicle stands, the camera looks towards this place and to both sides of it; none:
  /// along the path, or as `face` says.
  void look_for_way_to(const std::optional<Vec3>& p_W) { wants_way_to_W_ = p_W; }

  /// Measures the known-free distance again, after the path has changed.
  void refresh_known_free(const OccupancyView& map);
  /// The known-free distances of this path, measured by the node `check` in a newer map.
  void set_known_free(const TierDistances& free_until_m) { free_until_m_ = free_until_m; }
  /// A map with frames up to this time is the newest one.
  /// @param longest_range_m  Of a frame in it, whatever the knob of the range says.
  void map_captured(MissionTime captured,
                    double longest_range_m = std::numeric_limits<double>::infinity()) {
    newest_capture_ = captured;
    longest_range_m_ = longest_range_m;
  }
  /// Bound on the age of a map (`MapLatency::age_bound`): the latency from sensor to published map
  /// plus the interval between maps, which is delta without t_b. Until it is set, the vehicle does
  /// not move through space that has to be mapped.
  void set_latency_bound(Duration bound) { latency_bound_ = bound; }

  /// Moves the reference by `dt`. @param error_W  From the reference to the vehicle.
  PathReference tick(MissionTime now, Duration dt, const Vec3& error_W);

  /// The vehicle stands here, after something else than the path was flown: the reference goes on
  /// from rest, at the nearest place of the last 20 m. @pre There is a path.
  void pick_up_at(const Vec3& p_W);
  [[nodiscard]] bool has_path() const { return !path_->empty(); }
  [[nodiscard]] const Path& path() const { return *path_; }
  /// The same path, for readers that keep it; it never changes.
  [[nodiscard]] const std::shared_ptr<const Path>& shared_path() const { return path_; }
  [[nodiscard]] double s_m() const { return s_m_; }
  [[nodiscard]] double speed_m_s() const { return speed_m_s_; }
  [[nodiscard]] double target_speed_m_s() const { return target_m_s_; }
  [[nodiscard]] Vec3 position_W() const;
  [[nodiscard]] double yaw_rad() const { return yaw_rad_; }
  /// The error of a vehicle that is `error_W` away from its reference.
  [[nodiscard]] TrackingError tracking_error(const Vec3& error_W) const;
  /// From the reference to the first place that is not known to be free, for the body at slow
  /// speed.
  [[nodiscard]] double known_free_m() const { return std::max(0.0, free_until_m_.front() - s_m_); }
  /// Where a stop with this deceleration would end from here.
  [[nodiscard]] double stop_point_m(double deceleration_m_s2) const;
  /// Where a comfortable stop inside known-free space would end: the committed stop while a plan is
  /// searched for.
  [[nodiscard]] double planned_stop_m() const;
  /// The end of known-free space with room for the wide tube: the vehicle may fly on to here before
  /// it has to stop.
  [[nodiscard]] double farthest_stop_m() const;
  [[nodiscard]] bool is_at_end() const;
  /// The reference is at the end of its path, or has none.
  [[nodiscard]] bool stands_still() const { return !has_path() || is_at_end(); }
  /// How long the reference has stood still on a path that goes on.
  [[nodiscard]] Duration stalled(MissionTime now) const;
  /// Since when the camera of a reference that stands so has looked along its path.
  [[nodiscard]] std::optional<MissionTime> faces_path_since() const;
  [[nodiscard]] const Guard& guard() const { return guard_; }
  /// The bound in force; it is wider while the governor's fallback asks for that.
  [[nodiscard]] Duration latency_bound() const;

 private:
  /// The reference stands still on a path that goes on.
  struct Stall {
    MissionTime since{};
    std::optional<MissionTime> faces_path_since{};  ///< None: the camera has not turned to it yet.
  };
  void turn(MissionTime now, double dt_s);
  [[nodiscard]] bool arrives() const;
  void turn_towards(double yaw_rad, double dt_s);
  [[nodiscard]] SpeedProfile profile_of(const Path& path, double braking_m_s2) const;
  [[nodiscard]] double room_m(std::size_t tier) const;
  [[nodiscard]] double cruise_speed(std::size_t tier) const;
  /// It was told to brake and stand: that is no stall.
  [[nodiscard]] bool is_held() const;
  [[nodiscard]] double safe_cruise() const;
  /// Deceleration of a planned stop, m/s^2.
  [[nodiscard]] double stopping() const;
  [[nodiscard]] double brake_lag_s() const;
  [[nodiscard]] double speed_limit() const;
  [[nodiscard]] double next_speed(double dt_s, const Vec3& error_W);
  [[nodiscard]] double wait_for_vehicle(const Vec3& error_W) const;
  [[nodiscard]] double braked_speed(double dt_s) const;
  void turn_along_path(double dt_s, MissionTime now);
  void note_standstill(MissionTime now);
  [[nodiscard]] bool looks_for_way() const;
  [[nodiscard]] std::optional<double> wanted_yaw_rad(MissionTime now);
  void look_for_way(const Vec3& to_W, double dt_s);
  [[nodiscard]] double distance_since(MissionTime captured) const;

  [[nodiscard]] double speed_limit_at(const Vec3& p_W) const {
    return knobs_->speed_limit_m_s(brief_->site, p_W);
  }

  std::shared_ptr<const Brief> brief_;           ///< Owners: all nodes.
  std::shared_ptr<const KnobsInForce> knobs_{};  ///< Owners: whoever reads this snapshot.
  Guard guard_;
  std::shared_ptr<const Path> path_{std::make_shared<const Path>()};  ///< Owners: its readers.
  SpeedProfile profile_{};
  Vec3 hover_W_{Vec3::Zero()};
  double s_m_{};
  double speed_m_s_{};
  double target_m_s_{};
  double yaw_rad_{};
  double stop_at_m_{};
  TierDistances free_until_m_{};
  double travelled_m_{};
  Duration latency_bound_{};
  MissionTime newest_capture_{};
  double longest_range_m_{std::numeric_limits<double>::infinity()};
  std::optional<Stall> stall_{};
  std::optional<double> face_yaw_rad_{};
  bool must_stop_{};
  std::optional<Vec3> wants_way_to_W_{};
  double looked_s_{};  ///< For how long it has looked for a way.
  std::deque<std::pair<MissionTime, double>> odometer_{};
};

}  // namespace flyball
