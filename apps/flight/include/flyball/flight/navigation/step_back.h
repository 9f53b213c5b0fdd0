// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Flies back along the own track, to where the camera sees more.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/time.h"

#include <deque>
#include <optional>

namespace flyball {

/// The distance within which the camera cannot free cells. A cell counts as free only when it is
/// seen through as a whole, and nearer than this no cell of `cell_m` that the body reaches into is
/// seen as a whole. The distance is (cell + half height) over the tangent of half the vertical
/// field of view, plus one cell, because the unknown part may lie at a cell's far side, less the
/// body's radius.
///
/// @param half_field  Tangent of half the camera's vertical field of view, above zero.
[[nodiscard]] double blind_m(double cell_m, const Cylinder& body, double half_field);

/// A vehicle that has stopped nearer than that to unknown space would stay there for good, because
/// each frame shows the same as the last one; so would one from where no search finds a path. So it
/// flies back along its own track, waits there until a frame that was taken at rest is in the map,
/// and plans anew. It cannot see behind itself;
/// like the guard, it relies on obstacles that do not move.
class StepBack {
 public:
  struct Hover {
    Vec3 p_W{Vec3::Zero()};
    double yaw_rad{};
  };

  /// Remembers the place of the reference while the vehicle follows its path.
  void flew(const Vec3& p_W);
  /// The vehicle was put somewhere else: its track does not lead there.
  void forget();
  /// @param distance_m  To fly back; less where the remembered track is shorter.
  /// @param yaw_rad     Heading to look in from there.
  /// @return False when nothing has changed, because there is no track, or because the vehicle has
  ///         already flown back from about here as often as may help.
  [[nodiscard]] bool begin(double distance_m, double yaw_rad);
  /// Towards another goal, the same place may be left backwards as often again.
  void begin_goal();
  [[nodiscard]] bool is_active() const { return is_active_; }
  /// The next place and heading of the reference, given the present ones.
  ///
  /// @param is_at_it  The vehicle is as near to the reference as it can hold its place.
  [[nodiscard]] Hover tick(MissionTime now, Duration dt, const Hover& hover, bool is_at_it);
  /// Whether a frame that was taken at rest is in the map, whose newest one was taken at
  /// `captured`. If so, the manoeuvre has ended.
  [[nodiscard]] bool has_looked(MissionTime captured);

 private:
  std::deque<Vec3> trail_W_{};  ///< Oldest first.
  bool is_active_{};
  double left_m_{};
  double yaw_rad_{};
  std::optional<MissionTime> settled_{};
  Vec3 from_W_{Vec3::Zero()};  ///< Where the last manoeuvres began.
  int times_{};                ///< How many began there.
};

}  // namespace flyball
