// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Settings that change nothing, because the policy sets the same knob to a value of its own.

#include "flyball/scenario/override.h"

#include <string>
#include <vector>

namespace flyball {

/// One sentence with the way out for each of these settings that a preset of `fixed` overrules in
/// this scenario. Other policies choose in flight, so what they leave of a setting is not known.
[[nodiscard]] std::vector<std::string> overruled_settings(const Scenario& scenario,
                                                          const std::vector<Override>& given);

}  // namespace flyball
