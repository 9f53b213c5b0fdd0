// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Every number of a flight's summary under a name of its own.

#include "flyball/records/summary.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// In the order in which a reader wants them: those of each flight, then `kernel.<name>.<figure>`
/// and `quality.<name>`. A number that is not finite is left out.
[[nodiscard]] std::vector<std::pair<std::string, double>> figures_of(const Summary& summary);

/// The names of all figures that one of the flights has, each once, in that order.
[[nodiscard]] std::vector<std::string> figure_names(const std::vector<const Summary*>& flights);

}  // namespace flyball
