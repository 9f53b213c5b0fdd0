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
#include "flyball/runtime/guard.h"
#include "flyball/runtime/observation.h"

#include <vector>

namespace flyball {

struct EnergySearchSettings {
  double deceleration_m_s2{6.0};
  /// t_b: `VehicleModel::reaction_time` of the vehicle that is flown.
  double reaction_s{to_seconds(GuardSettings{}.reaction_time())};
  double margin_m{0.5};  ///< Body and tracking tube, subtracted from the distance. Chosen.
  double frame_s{0.05};  ///< Between two frames of the camera.
  /// Mean length of path from obstacle to obstacle; 0: there are none.
  double spacing_m{};
  double half_width_m{5.0};  ///< Half the width of such an obstacle: of a room, or of one of
                             ///< RoboRun's blocks with the space beside it.
  /// The first margin is about what the errors of a flight come to, and each late map widens it by
  /// 15 %: with .05 and .1, a level of some 50 maps spent most of its misses on the way to there.
  QuantileTracker::Settings bound{0.05, 0.15, 0.4};
  ClockScaling clock{0.9, 0.05};
  double learn_s{};  ///< Latency is learned until this mission time; 0: always.
};

/// A resolution that the map may have, and what is known of its cost before the first flight.
struct SearchLevel {
  double resolution_m{};
  double latency_s{};    ///< From capture to the published map at `range_m` and `clock_hz`.
  double range_slope{};  ///< In log latency over log range: 1 where rays dominate, 3 where volume.
  double most_range_m{25.0};  ///< Up to here depth noise leaves any gap open.
  double range_m{7.0};
  double clock_hz{};  ///< 0: the highest that there is.
};

/// What limits speed besides latency.
struct Surroundings {
  double speed_limit_m_s{};
  double least_range_m{};    ///< Of the map; the longest that a level allows counts as enough.
  double most_range_m{1e9};  ///< Of the map; the shortest range is always allowed.
  /// Up to here depth noise leaves the gaps ahead open, whatever their level allows; 0: unknown.
  double clear_range_m{};
  double deceleration_m_s2{};  ///< Of eq. 2; 0: as in the settings.
  /// How far the camera can see before the world, not the range, ends the view.
  double visibility_m{};
  /// No setting whose response is longer may be chosen if there is one with a shorter response.
  /// Both the learned response and the one that was expected before the flight count, because walls
  /// end most rays in a room, but not in the open space behind the next door. Outside of rooms, at
  /// most ten times the learned one is expected.
  double most_response_s{1e9};
  bool is_enclosed{};      ///< By walls, as in rooms.
  double coarsest_m{};     ///< The largest cells with which the path ahead is passable.
  double finest_m{};       ///< The smallest cells that may be chosen; 0: any.
  WaitingShare waits{};    ///< Raises the price of lower clocks.
  bool needs_top_clock{};  ///< A plan is being searched for, which the model does not price.
};

/// A setting with what is expected of it.
struct EnergyEstimate {
  MapSetting setting{};
  double response_s{};  ///< delta of eq. 2: predicted latency and interval, and t_b.
  double speed_m_s{};
  double joules_per_m{};
  double watts_per_second{};  ///< What one second of latency costs; 0 where it limits nothing.
};

/// Exact search of a small lattice for the least energy per metre of progress
///
///     J = (P_rotor(v) + P_computer) / v * l
///     l = 1 + (cell + sqrt(s^2 + w^2) - s) / spacing,  s = min(range - cell, visibility) - v delta
///
/// Here v is the speed of MAVBench's eq. 2 for the predicted latency. The calibrated bound does not
/// count here: it is for single maps, while energy adds up over all of them. With the bound in
/// place of the prediction, the search took cells that were too large. l is the length of the path
/// over that of the straight line: an obstacle of half width w that comes into view s ahead makes
/// the path longer by sqrt(s^2 + w^2) - s, and by the cell that its border fills. So small cells
/// and a long range are worth something even where the mission, not latency, limits the speed.
/// Neither a change of cells nor a failed plan has a price: .2 and 2.5 s of hover changed no
/// mission's energy (1.000 +- .011 and 1.000 in a forest, n 48).
///
/// Among settings that take less than a thousandth more than the best, the search takes the one
/// with the shortest response. It learns latency and rotor power from observations, and also how
/// much power the computer may take before it gets too hot (`ThermalLimit`); clocks beyond that are
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

  /// Learns from what the newest map shows of its cells and range, and from what the rotors, the
  /// cores and the thermometer show.
  void learn(const Observation& seen);
  /// The best setting. It counts as in force from now on.
  [[nodiscard]] EnergyEstimate choose(const Surroundings& around, MissionTime now);
  /// The setting while the vehicle is idle (`Idle`): a map of these cells and this range, at the
  /// lowest clock that still makes it within `within_s`, or the highest clock if none does, and
  /// `raised_by` steps above that. The computer takes a constant power, a part in proportion to its
  /// clock, and more per operation the higher the clock is. So while time costs nothing, a lower
  /// clock is cheaper. The setting counts as in force from now on.
  [[nodiscard]] MapSetting idle(
      double resolution_m, double range_m, double within_s, std::size_t raised_by, MissionTime now);
  [[nodiscard]] EnergyEstimate estimate(const MapSetting& setting,
                                        const Surroundings& around) const;
  [[nodiscard]] const MapSetting& in_force() const { return in_force_; }
  /// For a policy that has chosen a setting by another rule.
  void put_in_force(const MapSetting& setting, MissionTime now);
  [[nodiscard]] const EnergySearchSettings& settings() const { return settings_; }
  /// The learned power of the rotors in level flight.
  [[nodiscard]] Watts rotor_power(double speed_m_s) const { return rotors_.power(speed_m_s); }
  /// The power of the computer while maps with this setting take `map_s` each.
  [[nodiscard]] Watts computer_power(const MapSetting& setting, double map_s) const;
  /// What the last `choose` expected of each setting; infinite energy where it was not allowed.
  [[nodiscard]] const std::vector<EnergyEstimate>& weighed() const { return estimates_; }
  [[nodiscard]] const LatencyBound& bound() const { return bound_; }
  /// The level nearest to these cells, which somebody else may have set.
  [[nodiscard]] double nearest_cells_m(double any_m) const { return cells_m()[level(any_m)]; }
  /// Of all levels; the factor is that of the level in force.
  [[nodiscard]] BoundCount bounds() const;
  /// `most_late` holds where no map takes more than four times as long as predicted.
  [[nodiscard]] std::vector<LevelBounds> bound_levels() const;
  /// What it compares. Axes: cells [m], ranges [m], clocks [Hz], all ascending.
  [[nodiscard]] const OperatingPoints& points() const { return points_; }
  [[nodiscard]] const std::vector<double>& cells_m() const {
    return points_.axes()[cell_axis].values;
  }
  [[nodiscard]] const std::vector<double>& ranges_m() const {
    return points_.axes()[range_axis].values;
  }
  [[nodiscard]] const std::vector<double>& clocks_hz() const {
    return points_.axes()[clock_axis].values;
  }
  /// `SearchLevel::most_range_m` of these cells.
  [[nodiscard]] double most_range_m(double resolution_m) const {
    return most_range_m_[level(resolution_m)];
  }

 private:
  enum Axis : std::size_t { cell_axis, range_axis, clock_axis };  ///< Of the points.

  EnergySearch(const EnergySearchSettings& settings,
               const std::vector<SearchLevel>& levels,
               OperatingPoints points,
               const PowerCost& computer);
  [[nodiscard]] MapSetting setting(std::size_t point) const;
  [[nodiscard]] std::size_t level(double resolution_m) const;
  [[nodiscard]] double predicted_s(const MapSetting& setting) const;
  [[nodiscard]] double busy_cores(const MapSetting& setting, double latency_s) const;
  [[nodiscard]] double response_s(double latency_s) const;
  void note_clock(const Observation& seen);
  [[nodiscard]] Hertz mean_clock() const;
  void learn_latency(const Observation& seen);
  [[nodiscard]] bool is_allowed(const MapSetting& candidate,
                                const Surroundings& around,
                                double least_range_m) const;
  /// The response that must be reckoned with, whatever was learned where the vehicle is.
  [[nodiscard]] double feared_s(std::size_t point, const Surroundings& around) const;
  [[nodiscard]] EnergyEstimate best_of(const Surroundings& around, double least_range_m);

  EnergySearchSettings settings_;
  OperatingPoints points_;
  LatencyModels models_{};  ///< One for each level.
  LatencyBound bound_;
  RotorPower rotors_{};
  PowerCost computer_;
  ThermalLimit thermal_;
  double most_clock_hz_{};
  std::vector<double> most_range_m_{};       ///< Of each level.
  std::vector<EnergyEstimate> estimates_{};  ///< Of each point, in the decision being made.
  std::vector<double> expected_s_{};  ///< Response of each point before anything was learned.
  MapSetting in_force_{};
  MissionTime in_force_since_{};
  MissionTime cells_since_{};  ///< Since when these cells have been in force, with any range.
  std::uint64_t revision_{};
  LatencyBound::Ticket ticket_{};  ///< The next map's, issued when the last one came.
  MissionTime issued_{};
  Hertz issued_at_{1e9};        ///< The clock that the ticket assumes.
  double clock_factors_{};      ///< Sum over the observations since then, of the granted clocks.
  int looks_{};                 ///< Number of these observations.
  double other_core_ghz_{2.5};  ///< Busy cores of all but the map, times the clock. Learned; the
                                ///< first value is chosen: a core and a quarter at 2 GHz.
};

}  // namespace flyball
