// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which setting of map and clock takes the least energy for the next metre.

#include "flyball/governors/foresight.h"
#include "flyball/governors/latency_bound.h"
#include "flyball/governors/latency_model.h"
#include "flyball/governors/operating_points.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/power_model.h"
#include "flyball/governors/speed_limit.h"
#include "flyball/governors/thermal_limit.h"
#include "flyball/governors/waiting_share.h"
#include "flyball/runtime/observation.h"

#include <vector>

namespace flyball {

struct EnergySearchSettings {
  double deceleration_m_s2{6.0};
  double reaction_s{0.14};   ///< t_b: the guard's tick, a command's age and the brake's lag.
  double margin_m{0.5};      ///< Body and tracking tube, off the distance.
  double frame_s{0.05};      ///< Between two frames of the camera.
  double switching_j{60.0};  ///< Of a change of resolution: another map starts with one frame.
  double horizon_m{10.0};    ///< Over which a switch must pay, at least.
  /// Way per obstacle that is passed; 0: none is.
  double spacing_m{};
  double half_width_m{5.0};  ///< Of such an obstacle: half a room, or RoboRun's blocks and spaces.
  QuantileTracker::Settings bound{0.05, 0.05, 0.1};
  ClockScaling clock{0.9, 0.05};
  double learn_s{};  ///< Mission time after which latency is not learned any more; 0: it always is.
};

/// A resolution that the map may have, and what is known of its cost before the first flight.
struct SearchLevel {
  double resolution_m{};
  double latency_s{};    ///< From capture to the published map at `range_m` and `clock_hz`.
  double range_slope{};  ///< In log latency over log range: 1 where rays dominate, 3 where volume.
  double most_range_m{25.0};  ///< Depth noise there is still below half a cell.
  double range_m{7.0};
  double clock_hz{};  ///< 0: the highest that there is.
};

/// What limits speed besides latency.
struct Surroundings {
  double speed_limit_m_s{};
  double least_range_m{};      ///< Of the map; the longest that a level allows counts as enough.
  double most_range_m{1e9};    ///< Of the map; the shortest range is always allowed.
  double deceleration_m_s2{};  ///< Of eq. 2; 0: as in the settings.
  double sight_m{};  ///< Beyond this the world, not the range, ends what is known to be free.
  /// Nothing that responds later if anything is sooner, as it was learned or as it was expected
  /// before: rooms end most rays, and the open behind the next door does not.
  double most_response_s{1e9};
  double coarsest_m{};     ///< Largest cell with which the way ahead is passable.
  double large_m{1e9};     ///< Cells beyond this may shut what turns up next, and have a price:
  double large_j_m{};      ///< failed plans per metre times what one costs.
  double finest_m{};       ///< No smaller one: somebody else chooses the cells, or 0.
  WaitingShare waits{};    ///< Makes lower clocks dearer.
  bool needs_top_clock{};  ///< Plans are sought: they are not in the model.
};

/// A setting with what is expected of it.
struct EnergyEstimate {
  MapSetting setting{};
  double response_s{};  ///< delta of eq. 2: bounds on latency and interval, and t_b.
  double speed_m_s{};
  double joules_per_m{};      ///< With the share of switching.
  double watts_per_second{};  ///< Worth of one second of latency; 0 where it limits nothing.
};

/// Exact search of a small lattice for the least
///
///     J = (P_rotor(v) + P_computer) / v * way + switching / max(horizon, d) [+ large cells' price]
///     way = 1 + (cell + sqrt(s^2 + w^2) - s) / spacing,  s = min(range - cell, sight) - v delta
///
/// An obstacle of half width w that shows s ahead makes the way longer by the second term, and
/// by a cell that its border fills: so cells have a price and sight a worth where the mission, not
/// latency, limits the speed.
///
/// with v from MAVBench's eq. 2 for the calibrated bound on latency, and d its distance: as far as
/// is seen, the world stays as it is. Of settings that take less than a thousandth more than the
/// best, the one that responds soonest. Latency and rotor power are learned from observations, and
/// so is what the computer may take before it gets too hot (`ThermalLimit`): clocks beyond that are
/// not chosen. Nothing allocates after `make`.
class EnergySearch {
 public:
  /// @param levels  Finest first. @param ranges_m Ascending; each goes with each.
  /// @param computer  Its power at each clock.
  /// @error `invalid_input` when a knob does not exist or cannot be one of the values.
  static Result<EnergySearch> make(const EnergySearchSettings& settings,
                                   const std::vector<SearchLevel>& levels,
                                   const std::vector<double>& ranges_m,
                                   const KnobSettings& knobs,
                                   const PowerCost& computer);

  /// What the newest map, the rotors, the cores and the thermometer show of the setting that is in
  /// force.
  void learn(const Observation& seen);
  /// The best setting there is; it is taken to be in force from now on.
  [[nodiscard]] EnergyEstimate choose(const Surroundings& around, MissionTime now);
  /// Where latency buys no speed: a map of these cells and this range at the lowest clock that
  /// still makes it within `within_s`, or at the highest; `raised_by` clocks higher than that. (The
  /// computer takes a constant, a part in proportion to its clock, and per operation the more the
  /// higher the clock is: while time itself costs nothing, slower is cheaper.) In force from now
  /// on.
  [[nodiscard]] MapSetting rest(
      double resolution_m, double range_m, double within_s, std::size_t raised_by, MissionTime now);
  [[nodiscard]] EnergyEstimate estimate(const MapSetting& setting,
                                        const Surroundings& around) const;
  [[nodiscard]] const MapSetting& in_force() const { return in_force_; }
  /// For whoever chose a setting by himself.
  void put_in_force(const MapSetting& setting, MissionTime now);
  [[nodiscard]] const EnergySearchSettings& settings() const { return settings_; }
  /// In level flight, as learned.
  [[nodiscard]] Watts rotor_power(double speed_m_s) const { return rotors_.power(speed_m_s); }
  /// While maps are made with this setting, each of which takes so long.
  [[nodiscard]] Watts computer_power(const MapSetting& setting, double map_s) const;
  /// What the last `choose` expected of each setting; infinite joules where it was not allowed.
  [[nodiscard]] const std::vector<EnergyEstimate>& weighed() const { return estimates_; }
  [[nodiscard]] const LatencyBound& bound() const { return bound_; }
  /// The highest that leaves the computer below its first trip; the top one where there is none.
  [[nodiscard]] double most_clock_hz() const { return most_clock_hz_; }
  /// Of all levels; the factor is that of the level in force.
  [[nodiscard]] BoundCount bounds() const;
  /// `most_late` where no map takes more than four times as long as predicted.
  [[nodiscard]] std::vector<LevelBounds> bound_levels() const;
  [[nodiscard]] const OperatingPoints& points() const { return points_; }

 private:
  EnergySearch(const EnergySearchSettings& settings,
               const std::vector<SearchLevel>& levels,
               OperatingPoints points,
               const PowerCost& computer);
  [[nodiscard]] MapSetting setting(std::size_t point) const;
  [[nodiscard]] std::size_t level(double resolution_m) const;
  [[nodiscard]] double predicted_s(const MapSetting& setting) const;
  [[nodiscard]] double busy_cores(const MapSetting& setting, double latency_s) const;
  void note_clock(const Observation& seen);
  [[nodiscard]] Hertz mean_clock() const;
  void learn_latency(const Observation& seen);
  [[nodiscard]] bool is_allowed(const MapSetting& candidate,
                                const Surroundings& around,
                                double least_range_m) const;
  [[nodiscard]] EnergyEstimate best_of(const Surroundings& around, double least_range_m);

  EnergySearchSettings settings_;
  OperatingPoints points_;
  LatencyModels models_{};  ///< One for each level.
  LatencyBound bound_;
  RotorPower rotors_{};
  PowerCost computer_;
  ThermalLimit thermal_;
  double most_clock_hz_{};
  std::vector<EnergyEstimate> estimates_{};  ///< Of each point, in the decision being made.
  std::vector<double> expected_s_{};  ///< Response of each point before anything was learned.
  MapSetting in_force_{};
  MissionTime in_force_since_{};
  std::uint64_t revision_{};
  LatencyBound::Ticket ticket_{};  ///< Of the next map; it was issued when the last one came.
  MissionTime issued_{};
  Hertz issued_at_{1e9};    ///< The clock that the ticket counts on.
  double clock_factors_{};  ///< Sum over the looks since then, of the clocks that were granted.
  int looks_{};
  double other_core_ghz_{2.5};  ///< Busy cores of everything but the map, times the clock.
};

}  // namespace flyball
