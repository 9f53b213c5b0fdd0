// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Occupancy mapping: range scans in; free, occupied and unknown space out.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <string>
#include <vector>

namespace flyball {

struct MapperSettings {
  double resolution_m{0.15};
  double range_m{7.0};
};

/// Leaves of a map for pictures and files.
struct OccupiedCell {
  Vec3 centre_W{Vec3::Zero()};
  double size_m{};
};

/// Insertion is split in two, because on the modeled computer a map is computed when its job starts
/// and becomes visible when the job ends.
class Mapper : public Kernel {
 public:
  /// Settings of this implementation that stay for the mission, unlike knobs.
  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const { return {}; }
  /// Before the first `prepare`; without it every parameter has its default.
  ///
  /// @pre `chosen` was resolved from `parameters()`.
  virtual void configure([[maybe_unused]] const Parameters& chosen) {}

  /// Computes what a scan changes; the visible map stays as it is. Replaces an earlier `prepare`
  /// that was not committed.
  ///
  /// @param cloud_C   Returns beyond `range_m` free their ray up to that range and mark nothing.
  /// @param X_WC      Pose of the camera at `cloud_C.captured`.
  /// @param settings  A resolution other than the one in force starts (or resumes) the map of that
  ///                  resolution; the others answer where it is still unknown.
  /// @return          Work: `rays`, `traversals` (cells walked, with repeats), `updates` (unique
  /// cells).
  /// @error           `invalid_input` if a coordinate is not finite or a setting is not positive;
  ///                  nothing is prepared.
  virtual Result<Work> prepare(const PointCloud& cloud_C,
                               const Pose& X_WC,
                               const MapperSettings& settings) = 0;
  /// Makes the prepared change visible. Without one: nothing.
  virtual void commit() = 0;

  /// Marks the vehicle's own surroundings free where they are unknown: take-off and landing
  /// cylinders that the scenario declares clear, and the space that the body occupies. Visible at
  /// once.
  virtual void declare_clear(const Vec3& centre_W, const Cylinder& space) = 0;
  /// Answers from committed changes only. Lives as long as the mapper.
  [[nodiscard]] virtual const OccupancyView& view() const = 0;
  [[nodiscard]] virtual std::vector<OccupiedCell> occupied() const = 0;
};

}  // namespace flyball
