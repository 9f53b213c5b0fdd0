// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A policy without each of its parts, as presets that fly like any other.

#include "flyball/runtime/parameters.h"
#include "flyball/scenario/plugins.h"
#include "flyball/studies/part_gains.h"

#include <map>
#include <string>
#include <vector>

namespace flyball {

/// Which parts a policy can fly without: the choices of its text parameter `without`.
struct Ablations {
  std::string whole{};                                 ///< The policy or preset, as it was named.
  std::string policy{};                                ///< The policy whose parameters these are.
  std::map<std::string, ParameterValue> parameters{};  ///< Of the whole.
  std::vector<AblatedPolicy> variants{};
  std::string folder{};  ///< Where the variants' presets stand.

  /// The file of one of them.
  [[nodiscard]] std::string file_of(const AblatedPolicy& variant) const;
};

/// @error `not_found`: no such policy; `invalid_input`: it has no parameter `without`.
[[nodiscard]] Result<Ablations> find_ablations(const std::string& name,
                                               const Plugins& plugins,
                                               const std::string& folder);
[[nodiscard]] Status write_presets(const Ablations& ablations);

}  // namespace flyball
