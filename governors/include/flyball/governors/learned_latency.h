// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How long the next map will take with each setting, and an upper bound of it, learned in flight.

#include "flyball/governors/latency_bound.h"
#include "flyball/governors/latency_model.h"
#include "flyball/governors/map_setting.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/observation.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace flyball {

/// A resolution that the map may have, and what is known of its cost before the first flight.
struct LatencyLevel {
  double resolution_m{};
  double latency_s{};    ///< From capture to the published map at `range_m` and the top clock.
  double range_slope{};  ///< In log latency over log range: 1 where rays dominate, 3 where volume.
  double range_m{7.0};
};

/// Cells with the latencies that are expected of them: those of the finest and of the coarsest are
/// given, the others lie between them on a line in log-log, and so do the slopes over range.
/// @pre `resolutions_m` is not empty and ascends; both latencies are positive.
[[nodiscard]] std::vector<LatencyLevel> levels_between(const std::vector<double>& resolutions_m,
                                                       double fine_s,
                                                       double coarse_s);

/// Of whatever sensor; anything else is a fault of the observation.
[[nodiscard]] bool is_a_range(double any_m);
/// The same of a computer, 1 MHz to 1 THz.
[[nodiscard]] bool is_a_clock(double any_hz);

/// The time from one frame that a map may be made of to the next one [s]: of the camera where it is
/// known, behind the knobs camera.rate_hz and map.rate_hz where they exist, at the values that they
/// start with. A 20 Hz camera's where nothing is known.
[[nodiscard]] double frame_interval_s(const std::optional<DepthCameraSpec>& camera,
                                      const KnobSettings& knobs);

struct LearnedLatencySettings {
  /// `frame_interval_s`. A bound is about latency alone, so the wait for a frame must not count.
  double frame_s{0.05};
  /// The first margin is about what the errors of a flight come to, and each late map widens it by
  /// 15 %: with .05 and .1, a level of some 50 maps spent most of its misses on the way to there.
  QuantileTracker::Settings bound{0.05, 0.15, 0.4};
  ClockScaling clock{0.9, 0.05};
  double learn_s{};  ///< Latency is learned for so long from the first look on; 0: always.
};

/// Predicts with one model for each level, over range and clock, and bounds with one tracker for
/// each. It must be told which setting is in force, because a map counts only for the setting that
/// its frame was taken with. Nothing allocates after construction.
class LearnedLatency {
 public:
  /// @param levels    Finest first. @pre There is one at least.
  /// @param in_force  The setting that the mission begins with.
  LearnedLatency(const LearnedLatencySettings& settings,
                 const std::vector<LatencyLevel>& levels,
                 const MapSetting& in_force,
                 Hertz top_clock);

  /// From what the newest map shows of its cells and range. Once for each decision.
  void learn(const Observation& seen);
  /// What is predicted for a map, in seconds; of other cells than the levels', as of the nearest.
  [[nodiscard]] double predicted_s(const MapSetting& setting) const;
  /// The bound of that.
  [[nodiscard]] double bounded_s(const MapSetting& setting) const;

  [[nodiscard]] double top_clock_hz() const { return top_clock_.value(); }
  [[nodiscard]] const MapSetting& in_force() const { return in_force_; }
  /// The setting of the frames to come.
  void put_in_force(const MapSetting& setting, MissionTime now);

  /// Of all levels; the factor is that of the level in force.
  [[nodiscard]] BoundCount bounds() const;
  /// `most_late` holds where no map takes more than four times as long as predicted.
  [[nodiscard]] std::vector<LevelBounds> bound_levels() const;

 private:
  [[nodiscard]] std::size_t level(double resolution_m) const;
  void note_clock(const Observation& seen);
  [[nodiscard]] Hertz mean_clock() const;
  void learn_from(const Observation& seen, Hertz clock);

  LearnedLatencySettings settings_;
  std::vector<double> cells_m_{};  ///< Of the levels, ascending.
  LatencyModels models_{};         ///< One for each level.
  LatencyBound bound_;
  Hertz top_clock_;
  MapSetting in_force_;
  MissionTime in_force_since_{};
  MissionTime cells_since_{};  ///< Since when these cells have been in force, with any range.
  std::optional<MissionTime> first_look_{};
  std::uint64_t revision_{};
  MissionTime issued_{};    ///< When the last map came, and a bound for the next one was issued.
  Hertz issued_at_{1e9};    ///< The clock that this bound assumes.
  double clock_factors_{};  ///< Sum over the observations since then, of the granted clocks.
  int looks_{};             ///< Number of these observations.
};

}  // namespace flyball
