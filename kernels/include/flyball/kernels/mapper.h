// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Occupancy mapping: range scans in; free, occupied and unknown space out.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
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

/// What a map knows at one resolution. A cell counts as known when it is occupied or wholly free.
struct MapLevel {
  double cell_m{};
  std::uint64_t known_cells{};
  std::uint64_t occupied_cells{};
};

/// What a map holds, at each resolution that it answers at, finest first.
struct MapContents {
  std::vector<MapLevel> levels{};
  std::size_t bytes{};  ///< Of the store of cells, without work space.
};

/// @param resolutions_m  That a mapper maps at, ascending; empty: any.
[[nodiscard]] inline KnobSpec resolution_knob(const std::vector<double>& resolutions_m) {
  KnobSpec spec{"map.resolution_m",
                "m",
                "map",
                resolutions_m,
                0.05,
                2.0,
                0.15,
                "cell size at which depth is integrated"};
  if (!resolutions_m.empty()) {
    spec.min = resolutions_m.front();
    spec.max = resolutions_m.back();
    spec.fallback = spec.nearest(spec.fallback);
  }
  return spec;
}

/// A long range that is meant for large cells takes seconds in small ones, so both change at once.
[[nodiscard]] inline KnobSpec range_knob() {
  KnobSpec spec{"map.range_m", "m", "points", {}, 2.0, 25.0, 7.0, "how far depth is integrated"};
  spec.follows = "map.resolution_m";
  return spec;
}

/// Insertion is split in two, because on the modeled computer a map is computed when its job starts
/// and becomes visible when the job ends.
class Mapper : public Kernel {
 public:
  /// Resolutions that this implementation maps at, ascending, once it is configured; empty: any.
  [[nodiscard]] virtual std::vector<double> resolutions_m() const { return {}; }
  /// The range that `prepare` takes at most at this resolution. The knobs of both are turned by
  /// themselves, so whoever uses them has to cut the range.
  [[nodiscard]] virtual double longest_range_m([[maybe_unused]] double resolution_m) const {
    return std::numeric_limits<double>::infinity();
  }
  /// At which resolution, how far and how often depth is integrated.
  [[nodiscard]] std::vector<KnobSpec> knobs() const override {
    return {resolution_knob(resolutions_m()),
            range_knob(),
            {"map.rate_hz",
             "Hz",
             "points",
             {},
             0.5,
             60.0,
             20.0,
             "frames integrated a second, at most"}};
  }

  /// Computes what a scan changes; the visible map stays as it is. Replaces an earlier `prepare`
  /// that was not committed.
  ///
  /// @param cloud_C   Returns beyond `range_m` free their ray up to that range and mark nothing.
  /// @param X_WC      Pose of the camera at `cloud_C.captured`.
  /// @param settings  A resolution other than the one in force starts (or resumes) the map of that
  ///                  resolution; the others answer where it is still unknown.
  /// @return          Work: `rays`, `traversals` (cells walked, with repeats), `updates` (unique
  /// cells).
  /// @error           `invalid_input` if a coordinate is not finite, a setting is not positive or
  ///                  the range is beyond `longest_range_m`; nothing is prepared.
  virtual Result<Work> prepare(const PointCloud& cloud_C,
                               const Pose& X_WC,
                               const MapperSettings& settings) = 0;
  /// The same, of a frame whose points need not be made where its image says enough.
  virtual Result<Work> prepare_frame(const PointCloudFrame& frame,
                                     const Pose& X_WC,
                                     const MapperSettings& settings) {
    return prepare(frame.cloud_C.value(), X_WC, settings);
  }
  /// Makes the prepared change visible. Without one: nothing.
  virtual void commit() = 0;

  /// Marks the vehicle's own surroundings free where they are unknown: take-off and landing
  /// cylinders that the scenario declares clear, and the space that the body occupies. Visible at
  /// once.
  virtual void declare_clear(const Vec3& centre_W, const Cylinder& space) = 0;
  /// What occupied cells near `p_W` show may be noise: they become unknown, at once, until a scan
  /// shows again what is there, and free where space was declared clear. They are missing from
  /// files of the map, too. A mapper that cannot do so ignores it.
  ///
  /// @param radius_m  Around `p_W`. Cells up to 64 finest cells farther away may be doubted, too.
  virtual void doubt_obstacles([[maybe_unused]] const Vec3& p_W, [[maybe_unused]] double radius_m) {
  }
  /// Answers from committed changes only. Lives as long as the mapper.
  [[nodiscard]] virtual const OccupancyView& view() const = 0;
  /// The map as `view` shows it now, for readers on other threads: whatever the mapper does
  /// afterwards, it keeps its answers, and it may be asked by any number of threads at the same
  /// time, without a lock. To be called by the mapper's thread. The owners are those who hold
  /// copies of the pointer; the mapper is none, and the revision may outlive it. A reader should
  /// let go of an old revision when it takes a new one, because what has changed since then is kept
  /// for it.
  [[nodiscard]] virtual std::shared_ptr<const OccupancyView> revision() = 0;
  [[nodiscard]] virtual std::vector<OccupiedCell> occupied() const = 0;
  [[nodiscard]] virtual MapContents contents() const { return {}; }

  /// Writes the map as an OctoMap file, at its finest resolution or, where it has several, at
  /// `resolution_m`: occupied or free for a path that ends in `.bt`, log-odds for `.ot`. What was
  /// only declared clear is not in it.
  ///
  /// @error `invalid_input` for another ending or resolution, `failed` when nothing can be written
  ///        there: no file, or the old one, is left.
  [[nodiscard]] virtual Status write([[maybe_unused]] const std::string& path,
                                     [[maybe_unused]] std::optional<double> resolution_m) const {
    return Error{ErrorCode::unavailable, "this mapper writes no files; try: mapper flyball"};
  }
  /// What lies so far away that this mapper forgets it from now on goes into this file, which it
  /// deletes in the end, and `write` puts it back into the map. To be called before the first
  /// `prepare`, once configured.
  ///
  /// @error `failed` when the file cannot be made. What goes wrong later is an error of `write`.
  [[nodiscard]] virtual Status keep_forgotten([[maybe_unused]] const std::string& path) {
    return Done{};  // Most mappers forget nothing.
  }
  /// Replaces the map by that of an OctoMap file; the mapper's finest resolution becomes the
  /// file's. A file that is broken in any way is refused, and the map stays as it was.
  ///
  /// @error `not_found`, or `invalid_input` with what is wrong in the file.
  [[nodiscard]] virtual Status read([[maybe_unused]] const std::string& path) {
    return Error{ErrorCode::unavailable, "this mapper reads no files; try: mapper flyball"};
  }
};

}  // namespace flyball
