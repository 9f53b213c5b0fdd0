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
  /// From one frame that is mapped to the next, where some of the camera's are left out; else zero.
  Duration frame_interval{};
  /// The same of the frames by which the vehicle knows its place.
  Duration fix_interval{};
  bool is_offloaded{};  ///< The map is made on an edge computer.
  friend bool operator==(const MapTerms& a, const MapTerms& b) {
    return a.resolution_m == b.resolution_m && a.range_m == b.range_m && a.clock == b.clock &&
           a.cores == b.cores && a.frame_interval == b.frame_interval &&
           a.fix_interval == b.fix_interval && a.is_offloaded == b.is_offloaded;
  }
  friend bool operator!=(const MapTerms& a, const MapTerms& b) { return !(a == b); }
};

/// Of the knobs, and of the clock and cores that the platform grants.
[[nodiscard]] MapTerms terms_of(const KnobsInForce& knobs, const Brief& brief);

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
/// measured at: the last 20 of each cell size, range, number of cores and interval between frames.
class MeasuredShares {
 public:
  void add(MissionTime now, const MapTerms& terms, double share);
  /// 1.1 times the largest of these settings, or of the nearest ones that were measured; 1 if none
  /// were: the price itself. An edge computer may be at the end of any link, so that its times say
  /// nothing of those on board, nor these of its; until it has been measured there is no bound.
  [[nodiscard]] double bound(const MapTerms& terms) const;

 private:
  struct Window {
    LatencyWindow shares{Duration{}};  ///< A second stands for 1.
    MissionTime newest{};
  };
  /// By place, cores, cell size, range and interval between frames.
  std::map<std::tuple<bool, int, double, double, Duration>, Window> windows_{};
};

/// A bound is the largest measured share times the price of the settings in force, so that it
/// depends on these settings and on what was measured, and not on how often a knob was turned. A
/// map counts for the range of its newest frame, whatever range is in force when it is published.
/// One that was begun under other terms than that is not counted: a frame that was begun at a low
/// clock would hold the vehicle back for twenty maps.
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
  /// Where frames are left out, the interval is at least theirs from the moment on at which the
  /// knob is turned: a vehicle that waited for such an interval to be measured would fly too fast
  /// until then.
  [[nodiscard]] Duration latency_bound() const { return bounds_.latency; }
  [[nodiscard]] Duration interval_bound() const { return bounds_.interval; }
  /// Both, and how long the place may be carried on by the last speed because frames of the
  /// localizer are left out: what the vehicle flies meanwhile may differ from what it believes. It
  /// is the age of the newest map just before the next one. Zero before the first map.
  [[nodiscard]] Duration age_bound() const {
    return bounds_.latency + bounds_.interval + bounds_.reckoned;
  }
  /// The newest map's share of the bound that was in force when it came.
  [[nodiscard]] double budget_use() const { return budget_use_; }

 private:
  struct Bounds {
    Duration latency{};
    Duration interval{};
    Duration reckoned{};
  };
  [[nodiscard]] Duration price(const MapTerms& terms) const;
  [[nodiscard]] Bounds bounds_of(const MapTerms& terms) const;

  FramePrice price_;
  MeasuredShares latencies_{};
  MeasuredShares intervals_{};
  MapTerms terms_{};
  bool known_terms_{};
  MissionTime since_{};  ///< Since when all terms but the range hold; the first ones hold from the
                         ///< beginning.
  std::optional<MissionTime> last_published_{};
  Bounds bounds_{};
  double budget_use_{};
};

}  // namespace flyball
