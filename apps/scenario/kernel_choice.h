// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The families of kernels that a scenario chooses from, and any kernel made as it says.

#include "flyball/runtime/kernel.h"
#include "flyball/scenario/scenario.h"

#include <memory>
#include <string>
#include <typeindex>
#include <vector>

namespace flyball {

/// A family, and where a scenario says which of its kernels is used.
struct FamilyChoice {
  std::string name;         ///< The key in `[kernels]`: `mapper`.
  std::string description;  ///< What such a kernel does.
  std::type_index interface;
  std::string KernelSettings::*kernel;
  ParameterValues KernelSettings::*parameters;
  std::string* (*place)(Scenario&);  ///< Of the kernel's name.
  std::vector<std::string> (*names)();
  std::unique_ptr<Kernel> (*make)(const std::string& name);  ///< Null when there is none.

  /// For messages: `mapper "octomap"`.
  [[nodiscard]] std::string owner(const KernelSettings& kernels) const {
    return name + " \"" + kernels.*kernel + "\"";
  }
};

/// All of them, in the order in which data passes through them.
[[nodiscard]] const std::vector<FamilyChoice>& family_choices();
/// @pre `interface` is that of a family.
[[nodiscard]] const FamilyChoice& family_choice(std::type_index interface);

/// The kernel of a family that the scenario names, configured.
///
/// @error `not_found` (no such kernel, or a file that it needs), `invalid_input` with a sentence
/// for
///        each wrong parameter.
[[nodiscard]] Result<std::unique_ptr<Kernel>> make_kernel(const FamilyChoice& family,
                                                          const KernelSettings& kernels,
                                                          const FindModel& find_model);

template <class Family>
[[nodiscard]] Result<std::unique_ptr<Family>> make_kernel(const KernelSettings& kernels,
                                                          const FindModel& find_model = no_models) {
  auto kernel = make_kernel(family_choice(typeid(Family)), kernels, find_model);
  if (!kernel) {
    return kernel.error();
  }
  // What a family's factory makes is of that family.
  return std::unique_ptr<Family>{static_cast<Family*>(kernel->release())};
}

/// Looks for weights where the scenario says.
[[nodiscard]] FindModel model_finder(const Scenario& scenario);

}  // namespace flyball
