// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Settings that a plug-in declares for itself: those of the world's generator (`world.spread_m`)
/// and of kernels (`kernels.mapper_parameters.front_end`).

#include "scenario/scenario_reader.h"
#include <vector>

namespace flyball {

/// The parameters of one plug-in that a scenario names.
struct ParameterGroup {
  std::string selector;  ///< The key that names the plug-in: `world.generator`.
  std::string prefix;    ///< `world.`
  std::string owner;     ///< For messages: `world "forest"`.
  bool exists{};         ///< False when there is no such plug-in, so its parameters are unknown.
  std::vector<ParameterSpec> specs{};
  ParameterValues KernelSettings::*of_kernel{};  ///< Null: they are the world's.
};

[[nodiscard]] std::vector<ParameterGroup> parameter_groups(const Scenario& scenario);
/// The values of a group inside the scenario.
[[nodiscard]] ParameterValues& values_of(Scenario& scenario, const ParameterGroup& group);
[[nodiscard]] const ParameterValues& values_of(const Scenario& scenario,
                                               const ParameterGroup& group);

/// Reads the given values; unknown names are left to the caller. On success `scenario` holds every
/// value of every group.
///
/// @return  Errors: wrong types and bounds.
[[nodiscard]] std::vector<Error> read_parameters(Scenario& scenario, const GivenValues& given);

/// Joins errors into one, with a line for each. @pre There is at least one.
[[nodiscard]] Error joined(const std::vector<Error>& errors);
/// `no policy "slow"; try: flyball list policies`
[[nodiscard]] Error unknown(const std::string& what,
                            const std::string& name,
                            const std::string& list);
/// Checks the parameters of a plug-in; all mistakes come in one error.
[[nodiscard]] Result<Parameters> resolved(const std::string& owner,
                                          const std::vector<ParameterSpec>& specs,
                                          const ParameterValues& given);

}  // namespace flyball
