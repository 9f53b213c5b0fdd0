// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Quantiles of a few measured values.

#include <vector>

namespace flyball {

/// The p-quantile (0..1) by linear interpolation between order statistics; 0 for no values.
[[nodiscard]] double quantile(std::vector<double> values, double p);

}  // namespace flyball
