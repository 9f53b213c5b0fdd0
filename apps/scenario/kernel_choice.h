// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The families of kernels that a scenario chooses from, and any kernel made as it says.

#include "flyball/kernels/switched.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/platform.h"
#include "flyball/scenario/scenario.h"

#include <memory>
#include <string>
#include <typeindex>
#include <utility>
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
  std::vector<std::string> (*names)(const Plugins&);
  /// Null when there is none of this name.
  std::unique_ptr<Kernel> (*make)(const Plugins&, const std::string& name);

  // Null where no knob chooses among kernels of the family in flight.
  std::string KnobChoices::*kinds{};                                   ///< Names, with commas.
  std::unique_ptr<Kernel> (*join)(std::vector<KernelKind<Kernel>>){};  ///< Behind that knob.

  /// For messages: `mapper "octomap"`.
  [[nodiscard]] std::string owner(const KernelSettings& kernels) const {
    return name + " \"" + kernels.*kernel + "\"";
  }
  /// The kernel that a scenario names, then those that may take its place in flight.
  [[nodiscard]] std::vector<std::string> all_kinds(const Scenario& scenario) const;
};

/// All of them, in the order in which data passes through them.
[[nodiscard]] const std::vector<FamilyChoice>& family_choices();
/// @pre `interface` is that of a family.
[[nodiscard]] const FamilyChoice& family_choice(std::type_index interface);

/// The kernel of a family that the scenario names, configured.
///
/// @error `not_found` (no such kernel, or a file that it needs), `invalid_input` with a sentence
///        for each wrong parameter.
[[nodiscard]] Result<std::unique_ptr<Kernel>> make_kernel(const FamilyChoice& family,
                                                          const Plugins& plugins,
                                                          const KernelSettings& kernels,
                                                          const FindModel& find_model);

/// The same, and where a knob chooses among several kernels, all of them behind that knob. Those
/// beside the one that the scenario names have their default parameters.
///
/// @error As `make_kernel`.
[[nodiscard]] Result<std::unique_ptr<Kernel>> make_switchable(const FamilyChoice& family,
                                                              const Scenario& scenario,
                                                              const FindModel& find_model);

/// The knobs of what `make_switchable` makes. Knobs may follow from parameters, but not from model
/// files, so a missing file is no error.
///
/// @error As `make_kernel` otherwise.
[[nodiscard]] Result<std::vector<KnobSpec>> knobs_of(const FamilyChoice& family,
                                                     const Scenario& scenario);

/// Whether a knob chooses only among kernels that there are.
///
/// @param place   Of the setting, for the message: ` (mine.toml:7)`, or nothing.
/// @error         `not_found`: one sentence with the setting, its value and those that are legal.
[[nodiscard]] Status check_kinds(const FamilyChoice& family,
                                 const Scenario& scenario,
                                 const std::string& place = "");

/// Whether the platform has a price for each switch that a knob may ask for: a policy would else
/// learn that a switch costs nothing.
///
/// @error `invalid_input`: one sentence with the setting, its value and the way out.
[[nodiscard]] Status check_switch_prices(const FamilyChoice& family,
                                         const Scenario& scenario,
                                         const Platform& platform);

/// What a family's factory has made, as a kernel of that family.
template <class Family>
[[nodiscard]] std::unique_ptr<Family> of_family(std::unique_ptr<Kernel> kernel) {
  return std::unique_ptr<Family>{static_cast<Family*>(kernel.release())};
}

template <class Family>
[[nodiscard]] Result<std::unique_ptr<Family>> of_family(Result<std::unique_ptr<Kernel>> kernel) {
  if (!kernel) {
    return kernel.error();
  }
  return of_family<Family>(std::move(*kernel));
}

template <class Family>
[[nodiscard]] Result<std::unique_ptr<Family>> make_switchable(const Scenario& scenario,
                                                              const FindModel& find_model) {
  return of_family<Family>(make_switchable(family_choice(typeid(Family)), scenario, find_model));
}

template <class Family>
[[nodiscard]] Result<std::unique_ptr<Family>> make_kernel(const Plugins& plugins,
                                                          const KernelSettings& kernels,
                                                          const FindModel& find_model = no_models) {
  return of_family<Family>(
      make_kernel(family_choice(typeid(Family)), plugins, kernels, find_model));
}

/// Looks for weights where the scenario says.
[[nodiscard]] FindModel model_finder(const Scenario& scenario);

}  // namespace flyball
