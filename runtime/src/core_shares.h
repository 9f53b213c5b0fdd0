// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Who gets how much of the cores: the scheduling rule of the modeled computer.

#include <vector>

namespace flyball {

struct CoreClaim {
  int priority{};
  double most{1.0};  ///< Cores that the job can use.
};

/// Cores granted to each claim. Higher priorities are served first; equal ones share what is left
/// equally, and what a claim cannot use goes to its equals (water-filling), then to the next class.
///
/// @return  In the order of `claims`; the sum is at most `cores`.
[[nodiscard]] std::vector<double> share_cores(const std::vector<CoreClaim>& claims, double cores);

}  // namespace flyball
