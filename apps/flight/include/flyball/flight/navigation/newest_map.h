// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The newest map that has been published, and how old it may become.

#include "flyball/flight/navigation/guidance.h"
#include "flyball/flight/navigation/map_latency.h"
#include "flyball/flight/perception/map_revision.h"

#include <memory>
#include <optional>
#include <utility>

namespace flyball {

/// Where nothing maps obstacles, a declared map takes the place of a published one.
class NewestMap {
 public:
  explicit NewestMap(FramePrice price) : bounds_{std::move(price)} {}

  void declare(std::shared_ptr<const OccupancyView> map) { revision_.map = std::move(map); }
  /// Settings in force: see `MapLatency::note_terms`.
  bool note_terms(MissionTime now, const MapTerms& terms) { return bounds_.note_terms(now, terms); }
  /// A map was published; call `note_terms` first.
  void note(const MapRevision& revision, MissionTime published);
  /// For a command that knows the map: how the map was used, if no command has used it before.
  [[nodiscard]] std::optional<MapUse> first_use(MissionTime now);

  [[nodiscard]] bool has_map() const { return revision_.map != nullptr; }
  /// @pre `has_map()`
  [[nodiscard]] const OccupancyView& map() const { return *revision_.map; }
  /// Null before the first published map, also where one was declared.
  [[nodiscard]] std::shared_ptr<const OccupancyView> published() const {
    return revision_.number > 0 ? revision_.map : nullptr;
  }
  /// Its number is 0 before the first published map.
  [[nodiscard]] const MapRevision& revision() const { return revision_; }
  [[nodiscard]] MissionTime captured() const { return revision_.captured; }
  /// From the capture of its newest frame to its publication.
  [[nodiscard]] Duration latency() const { return latency_; }
  /// See `MapLatency::age_bound`.
  [[nodiscard]] Duration age_bound() const { return bounds_.age_bound(); }

 private:
  MapLatency bounds_;
  MapRevision revision_{};
  Duration latency_{};
  std::optional<MissionTime> unused_capture_{};  ///< Of a map that no command has used yet.
};

}  // namespace flyball
