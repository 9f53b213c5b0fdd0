// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// That no kernel flies without a price in the platform file, because it would take no time.

#include "flyball/runtime/platform.h"
#include "flyball/runtime/result.h"
#include "flyball/scenario/scenario.h"

#include <string>

namespace flyball {

struct PricedKernel {
  std::string price{};        ///< The name of its price: `[kernels.NAME]` of the platform file.
  std::string who{};          ///< What the scenario names, such as `detector "hog"`.
  std::string what{};         ///< What would cost no time.
  std::string other_means{};  ///< Than to add the price, as in "set ..., or "; may be empty.
};

/// @error The platform has no such price.
[[nodiscard]] Status check_price(const Scenario& scenario,
                                 const Platform& platform,
                                 const PricedKernel& kernel);

}  // namespace flyball
