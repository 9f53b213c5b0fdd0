// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a policy knows before an energy search has learned anything, and what a mission says
/// itself.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/policy_abilities.h"

#include <vector>

namespace flyball {

/// Cells with the latencies that are expected of them: those of the finest and of the coarsest are
/// given, the others lie between them on a line in log-log, and so do the slopes over range.
/// @pre `resolutions_m` is not empty and ascends; both latencies are positive.
[[nodiscard]] std::vector<SearchLevel> levels_between(const std::vector<double>& resolutions_m,
                                                      double fine_s,
                                                      double coarse_s);

/// Five ranges, equal steps in proportion, as latency has it. @pre 0 < `least_m` < `most_m`.
[[nodiscard]] std::vector<double> ranges_between(double least_m, double most_m);

/// d of eq. 2 that a setting promises: its range, or the world's end of sight if that is nearer,
/// less body and tube. The last cells in range are not seen as a whole. (1.2 m cells end what is
/// free .7 to 2.1 m before their range of 10 to 25 m, half a body's width included, those of .3 m
/// .55 to .8 m.)
[[nodiscard]] double free_ahead_m(const EnergySearchSettings& price,
                                  const MapSetting& setting,
                                  double sight_m);

/// The way over its straight line, as `EnergySearch` counts it: for cells of this size and what is
/// shown so far ahead of where the vehicle can stop.
[[nodiscard]] double way_over_line(const EnergySearchSettings& price,
                                   double resolution_m,
                                   double shows_m);

/// Limits of speed and braking; usual ones where an observation says nothing of sense. All else is
/// as `Surroundings` has it, with a world that lets see to any distance.
[[nodiscard]] Surroundings limits_of(const Observation& seen);

/// It cruises as fast as the mission lets it. Only there a second buys nothing: who is slower waits
/// for a plan, or brakes for one or for its goal.
[[nodiscard]] bool flies_at_limit(const Observation& seen);

/// What the newest map showed free along the committed path, from where its frame was taken [m]: d
/// of eq. 2, but for body and tube. It ends with the path, too: before a place where the vehicle
/// will stop anyway, latency makes it slower still. 0 where an observation says nothing of sense.
[[nodiscard]] double shown_free_m(const Observation& seen);

/// What a search weighed and would allow, as a policy shows it: least joules per metre first.
[[nodiscard]] std::vector<PolicyOption> options_of(const std::vector<EnergyEstimate>& weighed);

}  // namespace flyball
