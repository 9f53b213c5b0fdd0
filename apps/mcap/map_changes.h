// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which cells a map marks as occupied that it did not mark before.

#include "flyball/flight/perception/map_revision.h"
#include "flyball/mcap/flight_messages.h"
#include "flyball/runtime/messages.h"

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace flyball {

/// A published map can be asked for the state of a place, not for what has changed. So the cells
/// that the newest frame hit are looked at, and some of those that were told before: as many as
/// `looks_back` in turn. At another resolution all begins anew. Remembers `most_cells` cells, of
/// which the oldest are forgotten and may be told again: 24 MB.
class MapChanges {
 public:
  static constexpr std::size_t most_cells = std::size_t{1} << 19U;
  static constexpr std::size_t looks_back = 2000;

  /// Since the last call, in an order that depends on the calls only.
  /// @param hits_W  Places where the frame of this revision ended on something.
  [[nodiscard]] std::vector<CellChange> since_last(const MapRevision& revision,
                                                   const std::vector<Vec3>& hits_W);

 private:
  using Key = std::uint64_t;
  void look_at_hits(const MapRevision& revision,
                    const std::vector<Vec3>& hits_W,
                    std::vector<CellChange>& changes);
  void look_back(const MapRevision& revision, std::vector<CellChange>& changes);
  void remember(Key key);

  double resolution_m_{};
  std::unordered_set<Key> told_{};  ///< As occupied. Never walked through: its order is nobody's.
  std::vector<Key> list_{};         ///< The same, and some that are free again, by their age.
  std::size_t oldest_{};
  std::size_t next_look_{};
};

/// The points of a frame that has been made into a map: all that is looked at has been computed.
[[nodiscard]] std::vector<Vec3> hits_of(const PointCloudFrame& frame, const Pose& X_WC);

}  // namespace flyball
