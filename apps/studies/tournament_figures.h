// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a tournament says of single policies and of pairs, from the flights of one world.

#include "flyball/studies/tournament.h"

namespace flyball {

[[nodiscard]] DecisionFigures decisions_of(const std::vector<Summary>& flights,
                                           const std::string& policy,
                                           const KnownBounds& bounds);
[[nodiscard]] PairedDifference difference_of(const std::vector<Summary>& flights,
                                             const PolicyPair& pair);
/// Level by level, over all flights of the policy, also those that failed.
[[nodiscard]] std::vector<BoundFigures> bound_figures(const std::vector<Summary>& flights,
                                                      const std::string& policy);

}  // namespace flyball
