// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The names that a scenario may use: plug-ins, and data that is shipped.

#include "flyball/scenario/plugins.h"

#include <string>
#include <vector>

namespace flyball {

/// Implementations that can stand in for each other.
struct KernelFamily {
  std::string name;  ///< As in the scenario's section `kernels`: `mapper`.
  std::vector<std::string> kernels;
};
[[nodiscard]] std::vector<KernelFamily> kernel_families(const Plugins& plugins);

[[nodiscard]] std::vector<std::string> world_names(const Plugins& plugins);
[[nodiscard]] std::vector<std::string> workload_names(const Plugins& plugins);
/// Presets, and policies that have no preset of their name, sorted.
[[nodiscard]] std::vector<std::string> policy_names(const Plugins& plugins);

}  // namespace flyball
