// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The bound on how long a map takes, from the settings in force and from what was measured.

#include "flyball/flight/mission_topics.h"
#include "flyball/flight/perception/map_revision.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/platform.h"
#include "flyball/runtime/time.h"
#include "flyball/runtime/units.h"

#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace flyball {

/// The settings that a map's latency depends on.
struct MapTerms {
  double resolution_m{};
  double range_m{};
  Hertz clock{1e9};
  int cores{1};
  friend bool operator==(const MapTerms& a, const MapTerms& b) {
    return a.resolution_m == b.resolution_m && a.range_m == b.range_m && a.clock == b.clock &&
           a.cores == b.cores;
  }
  friend bool operator!=(const MapTerms& a, const MapTerms& b) { return !(a == b); }
};

/// Of the knobs, and of the clock and cores that the platform grants.
[[nodiscard]] MapTerms terms_of(const KnobsInForce& knobs);

/// What a frame costs, before one has been measured.
struct FramePrice {
  std::function<Duration(const MapTerms&)> of{};
  Duration least{};  ///< No frame takes less.
};

/// What a frame takes in the mapper by the platform's own price list: the frustum's volume over the
/// cell's bounds the updates, the rays' length over its edge the traversals. The least one has the
/// same rays, which end at once, and the highest clock.
[[nodiscard]] FramePrice frame_price(const Brief& brief);

/// Times as multiples of the platform's price of a frame, each with the settings that it was
/// measured at: the last 20 of each cell size, range and number of cores.
class MeasuredShares {
 public:
  void add(MissionTime now, const MapTerms& terms, double share);
  /// 1.1 times the largest of these settings, or of the nearest ones that were measured; 1 if none
  /// were: the price itself.
  [[nodiscard]] double bound(const MapTerms& terms) const;

 private:
  struct Window {
    LatencyWindow shares{Duration{}};  ///< A second stands for 1.
    MissionTime newest{};
  };
  std::map<std::tuple<int, double, double>, Window> windows_{};  ///< Cores, cell size, range.
};

/// A bound is the largest measured share times the price of the settings in force, so that it
/// depends on these settings and on what was measured, and not on how often a knob was turned. A
/// map that was begun under other settings than those it was published under is not counted: one
/// frame that was begun at a long range and a low clock would hold the vehicle back for twenty
/// maps.
class MapLatency {
 public:
  explicit MapLatency(FramePrice price);
  /// Settings in force; call at least at each publication, better at each tick.
  /// @return  Whether the bounds are others now.
  bool note_terms(MissionTime now, const MapTerms& terms);
  void published(const MapRevision& revision, MissionTime now);
  /// From sensor to published map, and from map to map. Since the settings may change while a map
  /// is made, these are the largest bounds of all settings that have been in force since the newest
  /// map. Zero before the first map, else within the least price and `longest_latency_bound`.
  [[nodiscard]] Duration latency_bound() const { return bounds_.latency; }
  [[nodiscard]] Duration interval_bound() const { return bounds_.interval; }
  /// The newest map's share of the bound that was in force when it came.
  [[nodiscard]] double budget_use() const { return budget_use_; }

 private:
  struct Bounds {
    Duration latency{};
    Duration interval{};
  };
  [[nodiscard]] Duration price(const MapTerms& terms) const;
  [[nodiscard]] Bounds bounds_of(const MapTerms& terms) const;

  FramePrice price_;
  MeasuredShares latencies_{};
  MeasuredShares intervals_{};
  MapTerms terms_{};
  bool known_terms_{};
  MissionTime since_{};  ///< Since when the terms hold; the first ones hold from the beginning.
  std::optional<MissionTime> last_published_{};
  Bounds bounds_{};
  double budget_use_{};
};

}  // namespace flyball
