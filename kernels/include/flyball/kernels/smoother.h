// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Smoothing: a polygon of way-points in, a polynomial trajectory out.

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/trajectory.h"
#include "flyball/runtime/work.h"

#include <limits>
#include <vector>

namespace flyball {

struct SmoothRequest {
  std::vector<Vec3> waypoints_W{};  ///< At least two, neighbours apart.
  Vec3 start_velocity_W{
      Vec3::Zero()};  ///< Direction in which the committed path arrives; may be zero.
  double max_speed_m_s{};
  double max_acceleration_m_s2{};
  Cylinder body{};
  /// The body's centre stays inside, as in the plan.
  Aabb bounds_W{Vec3::Constant(-std::numeric_limits<double>::infinity()),
                Vec3::Constant(std::numeric_limits<double>::infinity())};
  /// Of straight pieces that are not the plan's. A bend into a climb is steeper than the climb,
  /// whose line it has to reach.
  double max_slope_rad{PlanRequest{}.max_slope_rad};
};

struct SmoothPath {
  Trajectory trajectory{};
  Work work{};  ///< `pieces`, `solves`, `collision_queries`.
};

class Smoother : public Kernel {
 public:
  /// Speed and acceleration stay within their limits; the body hits no occupied cube. Where the
  /// curve cuts a corner the piece is split, at last down to the polygon itself, flown with stops.
  ///
  /// @error `failed` when the polygon itself collides; `invalid_input` for fewer than two points.
  virtual Result<SmoothPath> smooth(const SmoothRequest& request, const OccupancyView& map) = 0;
};

}  // namespace flyball
