// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A lower bound on the energy of a delivery, whatever computer and policy fly it.

#include "flyball/runtime/result.h"
#include "flyball/scenario/scenario.h"

#include <string>
#include <vector>

namespace flyball {

/// One direction of the mission.
struct BoundedLeg {
  double energy_j{};
  double length_m{};  ///< Of the path with that energy; an under-estimate.
};

struct EnergyBound {
  std::vector<BoundedLeg> legs{};  ///< Out with the payload, back without.
  [[nodiscard]] double energy_j() const;
};

/// The energy of the cheapest path through the true world, flown everywhere as fast as possible:
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
/// - The path is Dijkstra's over cells of .25 m that have room for the bare body at some height,
/// with eight neighbours. Its length is divided by 1.0824, because such paths can be longer than
/// straight ones by at most that factor.
///
/// It is not a policy, because it sees the true world.
///
/// @error `invalid_input` for other missions than `package_delivery`, and in gusts.
///        `failed` when no path leads to the goal.
[[nodiscard]] Result<EnergyBound> bound_energy(const Scenario& scenario);

[[nodiscard]] std::string to_json(const EnergyBound& bound, const Scenario& scenario);

}  // namespace flyball
