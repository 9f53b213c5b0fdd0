// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The bound on what a map takes, for the setting that makes the next one.

#include "flyball/runtime/guard.h"
#include "flyball/runtime/time.h"
#include "flyball/runtime/units.h"

#include "flight/mission_context.h"
#include <map>
#include <optional>
#include <utility>

namespace flyball {

/// What a map's latency depends on.
struct MapTerms {
  double resolution_m{};
  double range_m{};
  Hertz clock{1e9};
  friend bool operator==(const MapTerms& a, const MapTerms& b) {
    return a.resolution_m == b.resolution_m && a.range_m == b.range_m && a.clock == b.clock;
  }
  friend bool operator!=(const MapTerms& a, const MapTerms& b) { return !(a == b); }
};

[[nodiscard]] MapTerms terms_of(const KnobSettings& knobs);

/// What a frame takes in the mapper by the platform's own price list, before one has been measured:
/// the frustum's volume over the cell's bounds the updates, the rays' length over its edge the
/// traversals.
[[nodiscard]] Duration expected_latency(const MissionContext& context, const MapTerms& terms);

/// Latencies and intervals of the last 20 maps of each resolution and range, as multiples of what
/// the platform expects of that setting, so that another clock does not outdate them. A map that
/// was begun under other terms than those it was published under belongs to neither: counted, one
/// frame that was begun at a long range and a low clock would hold the vehicle back for twenty
/// maps.
class MapLatency {
 public:
  /// Terms in force; call at least at each publication, better at each tick.
  void note_terms(MissionTime now, const MapTerms& terms);
  /// The same of a mission's knobs. What a lowered clock delays is known at once; the next map,
  /// which would show it, is itself late.
  /// @return  Whether the bounds are others now.
  bool note_knobs(MissionTime now, const MissionContext& context);
  /// The clock was lowered: the map that is being made takes so many times as long, and so may all
  /// until one shows better. (A clock that is raised shortens the bounds with the next map.)
  void stretch(double factor);
  /// @param expected  What the platform expects a frame to take under the terms in force.
  void published(const MapRevision& revision, MissionTime now, Duration expected);
  /// For the terms in force: from sensor to published map, and from map to map.
  [[nodiscard]] Duration latency_bound() const { return latency_bound_; }
  [[nodiscard]] Duration interval_bound() const { return interval_bound_; }
  /// The newest map's share of the bound that was in force when it came: of that before a clock
  /// was raised, since it was begun then.
  [[nodiscard]] double budget_use() const { return budget_use_; }

 private:
  /// In multiples of what is expected: one second of these stands for it.
  struct Windows {
    LatencyWindow latency;
    LatencyWindow interval;
  };
  [[nodiscard]] Windows& windows();

  std::map<std::pair<double, double>, Windows> windows_{};  ///< By resolution and range.
  MapTerms terms_{};
  bool known_terms_{};
  MissionTime since_{};  ///< The first ones hold from the beginning.
  std::optional<MissionTime> last_published_{};
  Duration latency_bound_{};
  Duration interval_bound_{};
  double budget_use_{};
};

}  // namespace flyball
