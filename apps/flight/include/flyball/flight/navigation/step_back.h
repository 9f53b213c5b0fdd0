// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Back along its own way, out of the camera's blind zone.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/time.h"

#include <deque>
#include <optional>

namespace flyball {

/// A cell counts as free when it is seen through as a whole, and nearer than this the camera sees
/// no cell of `cell_m` as a whole that the body reaches into: (cell + half height) over the tangent
/// of half the vertical field of view, and a cell more, for that is how far the near side of one
/// may be from what is unknown of it. Less the body's radius: from its centre to what blocks it.
///
/// @param half_field  Tangent of half the camera's vertical field of view, above zero.
[[nodiscard]] double blind_m(double cell_m, const Cylinder& body, double half_field);

/// A vehicle that has come to rest nearer than that before unknown space stays there: each frame
/// shows what the last one did. It goes back along the way that it came, looks from there until a
/// frame that was taken at rest is in the map, and begins anew. It sees nothing behind it: this
/// counts on obstacles that stay where they are, as the guard does.
class StepBack {
 public:
  struct Hover {
    Vec3 p_W{Vec3::Zero()};
    double yaw_rad{};
  };

  /// The reference of a vehicle that follows its path.
  void flew(const Vec3& p_W);
  /// Put somewhere else: nothing is known of the way there.
  void forget();
  /// @param distance_m  To go back; less where the way it remembers is shorter.
  /// @param yaw_rad     What it looks at from there.
  /// @return False, and nothing changed: it has not come from anywhere, or it has been back from
  ///         about here as often as may help.
  [[nodiscard]] bool begin(double distance_m, double yaw_rad);
  [[nodiscard]] bool is_active() const { return is_active_; }
  /// Where the reference is next, from what it is now.
  ///
  /// @param error_m  Between vehicle and reference.
  [[nodiscard]] Hover tick(MissionTime now, Duration dt, const Hover& hover, double error_m);
  /// The newest frame in the map was taken at `captured`: has it seen enough? Then this has ended.
  [[nodiscard]] bool has_looked(MissionTime captured);

 private:
  std::deque<Vec3> trail_W_{};  ///< Oldest first.
  bool is_active_{};
  double left_m_{};
  double yaw_rad_{};
  std::optional<MissionTime> settled_{};
  Vec3 from_W_{Vec3::Zero()};  ///< Where the last ones began.
  int times_{};                ///< So often there.
};

}  // namespace flyball
