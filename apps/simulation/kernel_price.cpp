// SPDX-License-Identifier: BSD-3-Clause
// tested-in: seeing_setup
#include "simulation/kernel_price.h"

namespace flyball {

Status check_price(const Scenario& scenario, const Platform& platform, const PricedKernel& kernel) {
  if (platform.knows(kernel.price)) {
    return Done{};
  }
  return Error{ErrorCode::invalid_input,
               "platform \"" + scenario.platform.name + "\" has no price for " + kernel.who +
                   ", so " + kernel.what + " would cost no time; " + kernel.other_means +
                   "add [kernels." + kernel.price + "] to the platform file"};
}

}  // namespace flyball
