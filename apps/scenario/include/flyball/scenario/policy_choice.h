// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The policy that a scenario names.

#include "flyball/governors/policy_file.h"
#include "flyball/scenario/scenario.h"

#include <string>
#include <vector>

namespace flyball {

/// @param name     A preset, a policy with its default parameters, or a path to a policy's file
///                 (policy_file.h).
/// @param plugins  With the policies that names stand for.
/// @param seed     Of the random stream that a file's policy may draw from.
/// @error `not_found` with the way out; those of `load_policy`.
[[nodiscard]] Result<PolicyChoice> choose_policy(const std::string& name,
                                                 const Plugins& plugins,
                                                 std::uint64_t seed);

/// The policies that are asked: this one, or the two that a combination names.
[[nodiscard]] std::vector<std::string> asked_policies(const std::string& name);

/// All files that the policy consists of, also those that a preset or a combination names.
[[nodiscard]] std::vector<std::string> files_behind_policy(const std::string& name);

/// The library whose code would run if the policy was chosen, also where a preset or a combination
/// names it; empty: none. Loads nothing.
[[nodiscard]] std::string library_of_policy(const std::string& name);

/// The scenario's, ready to decide on this board; also a preset that combines two others
/// (combined_policy.h), whose application is asked once per `governor.period_s`.
[[nodiscard]] Result<std::unique_ptr<Policy>> start_policy(const Scenario& scenario,
                                                           const KnobSettings& knobs,
                                                           const BoardModel& board);

}  // namespace flyball
