// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What is known of a computer before it flies, for whoever decides how it runs.

#include "flyball/runtime/platform.h"

#include <optional>
#include <vector>

namespace flyball {

/// Operating points, power and heat of one computer, as its platform file or its maker's data sheet
/// has them. What is left out is not known: a board that is all defaults is one of which nothing
/// is.
struct BoardModel {
  int max_cores{};                        ///< That may run jobs; 0: not known.
  std::vector<Hertz> frequencies{};       ///< Ascending; empty: not known.
  Duration switching_time{};              ///< How long a change of the clock takes.
  std::optional<PowerCost> power{};       ///< Input power of the whole computer.
  std::optional<ThermalModel> thermal{};  ///< Empty: it is not known to get too hot.
};

/// What a platform's file says of the board; what work costs in time is left to be learned in
/// flight.
[[nodiscard]] BoardModel board_model_of(const PlatformModel& platform);

}  // namespace flyball
