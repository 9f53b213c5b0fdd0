// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a delivery takes at least, whatever computer and policy fly it.

#include "flyball/runtime/result.h"
#include "flyball/scenario/scenario.h"

#include <string>
#include <vector>

namespace flyball {

/// One way of the mission.
struct BoundedLeg {
  double energy_j{};
  double length_m{};  ///< Of the way that takes it, an under-estimate.
};

struct EnergyBound {
  std::vector<BoundedLeg> legs{};  ///< Out with the payload, back without.
  [[nodiscard]] double energy_j() const;
};

/// The least-energy way through the true world, at each place as fast as anything allows:
///
///     E = sum ds (P_rotor(v) + P_computer) / v
///
/// - v is the mission's or the zone's limit, or eq. 2 with the whole of the longest range free and
///   the least latency: the guard's reaction and the point cloud of one frame at the top clock,
///   with nothing for the map.
/// - P_rotor is eq. 1 in steady level flight (or hover's power of the thrust model, which no flight
///   of that weight has a lower mean than: power goes with thrust^1.5, which is convex).
/// - P_computer is the idle computer at its lowest clock.
/// - Speeding up, turning, climbing, take-off, landing and hovering are free.
/// - The way is Dijkstra's over cells of .25 m that hold the bare body somewhere at some height, to
///   eight neighbours, over 1.0824: so much longer than straight ones such ways can be at most.
///
/// No policy: it sees the world.
///
/// @error `invalid_input` for other missions than `package_delivery`, and in gusts.
///        `failed` when no way leads to the goal.
[[nodiscard]] Result<EnergyBound> bound_energy(const Scenario& scenario);

[[nodiscard]] std::string to_json(const EnergyBound& bound, const Scenario& scenario);

}  // namespace flyball
