// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which clock takes the least energy for the next metre, with a map that somebody else has set.

#include "flyball/governors/idle.h"
#include "flyball/governors/learned_latency.h"
#include "flyball/governors/map_setting.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/power_model.h"
#include "flyball/governors/surroundings.h"
#include "flyball/governors/thermal_limit.h"
#include "flyball/governors/waiting_share.h"
#include "flyball/runtime/decision.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/result.h"

#include <optional>
#include <vector>

namespace flyball {

struct ClockSearchSettings {
  /// t_b: `VehicleModel::reaction_time` of the vehicle that is flown.
  double reaction_s{to_seconds(GuardSettings{}.reaction_time())};
  /// While the vehicle waits, a map may take so long, unless the mission says.
  double rest_s{1.0};
  /// Share of the energy of a metre that a lower clock must save at least, or the highest stays.
  double least_saving{};
  LearnedLatencySettings latency{};
};

/// A setting with what is expected of it.
struct EnergyEstimate {
  MapSetting setting{};
  double response_s{};  ///< delta of eq. 2: predicted latency and interval, and t_b.
  double speed_m_s{};
  double joules_per_m{};
  double watts_per_second{};  ///< What one second of latency costs; 0 where it limits nothing.
};

/// The distance d of eq. 2 that a setting gives: its range, or the visibility if that is shorter,
/// less body and tube. The camera does not see the last cells within the range as a whole, so they
/// do not count as free. (With cells of 1.2 m and a range of 10 to 25 m, known-free space ends .7
/// to 2.1 m before the range, half a body's width included; with cells of .3 m, .55 to .8 m.)
[[nodiscard]] double free_ahead_m(const MapSetting& setting, double visibility_m);

/// delta of eq. 2 for maps that take `latency_s` each: the next map takes about as long as this one
/// did, and begins with the next frame at the earliest.
[[nodiscard]] double response_s(const ClockSearchSettings& settings, double latency_s);

/// The wishes for the map and the clock, with `Reason::energy`.
[[nodiscard]] Decision decision_for(const MapSetting& setting);

/// The settings that were compared and are allowed, with the least energy per metre first.
[[nodiscard]] std::vector<PolicyOption> options_of(const std::vector<EnergyEstimate>& weighed);

/// Compares all clocks by the energy of a metre of progress
///
///     J = (P_rotor(v) + P_computer) / v * W
///
/// Here v is the speed of MAVBench's eq. 2 for the predicted latency, and W what the mission may
/// lose by waiting longer for everything else that it computes (`WaitingShare`). The calibrated
/// bound does not count here: it is for single maps, while energy adds up over all of them. A lower
/// clock is compared only where nothing but the map holds the vehicle up (`is_held_up`), and taken
/// only where it saves `least_saving`.
///
/// While the vehicle is idle (`Idle`), it takes the lowest clock whose maps come soon enough. The
/// computer takes a constant power, a part in proportion to its clock, and more per operation the
/// higher the clock is; so while time costs nothing, a lower clock is cheaper.
///
/// It learns latency and rotor power from observations, and how much power the computer may take
/// before it gets too hot (`ThermalLimit`); clocks beyond that are not chosen. Nothing allocates
/// after `make`.
class ClockSearch {
 public:
  /// @param levels    Of the map, finest first.
  /// @param computer  Its power at each clock.
  /// @error `invalid_input` when there is no knob for the clock or it has no list of clocks, or a
  /// clock, the range or the cells of a level may be 0.
  static Result<ClockSearch> make(const ClockSearchSettings& settings,
                                  const std::vector<LatencyLevel>& levels,
                                  const KnobSettings& knobs,
                                  const PowerCost& computer);

  /// Once for each decision, before it.
  void learn(const Observation& seen);
  /// How long a map may take now [s], if the vehicle is idle. Once for each decision.
  [[nodiscard]] std::optional<double> idle_map_s(const Observation& seen) {
    return idle_.allowed_s(seen);
  }
  /// The least clock for a map that may take so long. It counts as in force from now on.
  /// @param map  Its clock is ignored, here and below.
  MapSetting rest(const MapSetting& map, double within_s, MissionTime now);
  /// The clock of the least energy per metre. It counts as in force from now on.
  /// @param needs_top  Something is computed that the price does not count.
  MapSetting choose(const MapSetting& map, const Observation& seen, bool needs_top);

  [[nodiscard]] EnergyEstimate estimate(const MapSetting& setting,
                                        const Surroundings& around) const;
  /// What the last decision expected of each clock; infinite energy where it was not allowed.
  [[nodiscard]] const std::vector<EnergyEstimate>& weighed() const { return estimates_; }
  [[nodiscard]] const LearnedLatency& latency() const { return latency_; }
  [[nodiscard]] const MapSetting& in_force() const { return latency_.in_force(); }
  [[nodiscard]] const std::vector<double>& clocks_hz() const { return clocks_hz_; }  ///< Ascending.

 private:
  ClockSearch(const ClockSearchSettings& settings,
              const std::vector<LatencyLevel>& levels,
              const MapSetting& first,
              const std::vector<double>& clocks_hz,
              const PowerCost& computer);
  [[nodiscard]] double busy_cores(const MapSetting& setting, double latency_s) const;
  [[nodiscard]] Watts computer_power(const MapSetting& setting, double latency_s) const;
  void weigh(const MapSetting& map, const Surroundings& around, double least_clock_hz);

  ClockSearchSettings settings_;
  std::vector<double> clocks_hz_;
  LearnedLatency latency_;
  RotorPower rotors_{};
  PowerCost computer_;
  ThermalLimit thermal_;
  Idle idle_;
  WaitingShare waits_{};
  double most_clock_hz_;                     ///< That the computer bears.
  std::vector<EnergyEstimate> estimates_{};  ///< Of each clock, in the decision being made.
  double other_core_ghz_{2.5};  ///< Busy cores of all but the map, times the clock. Learned; the
                                ///< first value is chosen: a core and a quarter at 2 GHz.
};

}  // namespace flyball
