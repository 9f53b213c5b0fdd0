// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a policy knows before an energy search has learned anything, and what a mission says
/// itself.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/runtime/knob.h"

#include <vector>

namespace flyball {

/// Cells with the latencies that are expected of them: those of the finest and of the coarsest are
/// given, the others lie between them on a line in log-log, and so do the slopes over range.
/// @pre `resolutions_m` is not empty and ascends; both latencies are positive.
[[nodiscard]] std::vector<SearchLevel> levels_between(const std::vector<double>& resolutions_m,
                                                      double fine_s,
                                                      double coarse_s);

/// The smallest cells that a policy uses: those nearest to `given_m` or, where that is 0, the
/// finest of the mapper, which a mission chooses for its narrowest gap. A mapper without a lattice
/// has none, and gets .15 m.
[[nodiscard]] double smallest_cells_m(const KnobSpec& resolution, double given_m);

/// Five ranges with equal ratios between them, because latency grows with a power of the range.
/// @pre 0 < `least_m` < `most_m`.
[[nodiscard]] std::vector<double> ranges_between(double least_m, double most_m);

/// The distance d of eq. 2 that a setting gives: its range, or the visibility if that is shorter,
/// less body and tube. The camera does not see the last cells within the range as a whole, so they
/// do not count as free. (With cells of 1.2 m and a range of 10 to 25 m, known-free space ends .7
/// to 2.1 m before the range, half a body's width included; with cells of .3 m, .55 to .8 m.)
[[nodiscard]] double free_ahead_m(const EnergySearchSettings& price,
                                  const MapSetting& setting,
                                  double visibility_m);

/// The length of a path over that of its straight line, l of `EnergySearch`, for cells of this size
/// and a view that reaches `shows_m` beyond the place where the vehicle can stop.
[[nodiscard]] double path_over_line(const EnergySearchSettings& price,
                                    double resolution_m,
                                    double shows_m);

/// The limits of speed and braking of an observation, or usual ones where its values make no sense.
/// All else has its default, and visibility is unlimited.
[[nodiscard]] Surroundings limits_of(const Observation& seen);

/// Width of a path that has nothing beside it, as an observation tells it [m].
constexpr double open_path_m = 6.0;

/// Whether something beside the latency of maps makes the vehicle slower than the mission allows:
/// it stands, a plan has failed, or obstacles narrow its path. The search does not price what plans
/// and turns cost there, so a lower clock may lose more than the search expects.
[[nodiscard]] bool is_held_up(const Observation& seen);

/// How far the newest map showed the committed path as free, from the place where its frame was
/// taken [m]: d of eq. 2, without the allowance for body and tube. It also ends where the path
/// ends, because before a place where the vehicle will stop, latency slows it down further. 0 where
/// the values of an observation make no sense.
[[nodiscard]] double shown_free_m(const Observation& seen);

/// The wishes for the map and the clock, with `Reason::energy`.
[[nodiscard]] Decision decision_for(const MapSetting& setting);

/// The settings that a search compared and allows, with the least energy per metre first.
[[nodiscard]] std::vector<PolicyOption> options_of(const std::vector<EnergyEstimate>& weighed);

}  // namespace flyball
