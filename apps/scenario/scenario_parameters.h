// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Settings that a plug-in declares for itself: those of the world's generator (`world.spread_m`)
/// and of kernels (`kernels.mapper_parameters.front_end`).

#include "flyball/kernels/detector.h"
#include "flyball/kernels/localizer.h"
#include "flyball/kernels/mapper.h"

#include "scenario/scenario_reader.h"
#include <memory>
#include <vector>

namespace flyball {

using ParameterValues = std::map<std::string, ParameterValue>;

/// The parameters of one plug-in that a scenario names.
struct ParameterGroup {
  std::string selector;  ///< The key that names the plug-in: `world.generator`.
  std::string prefix;    ///< `world.`
  std::string owner;     ///< For messages: `world "forest"`.
  bool exists{};         ///< False: of a plug-in that does not exist nobody knows the parameters.
  std::vector<ParameterSpec> specs{};
};

[[nodiscard]] std::vector<ParameterGroup> parameter_groups(const Scenario& scenario);
/// Where a group's values are kept.
[[nodiscard]] ParameterValues& values_of(Scenario& scenario, const ParameterGroup& group);
[[nodiscard]] const ParameterValues& values_of(const Scenario& scenario,
                                               const ParameterGroup& group);

/// Takes what was given; unknown names are left to the caller. On success the groups' values are
/// in `scenario`, every one of them.
///
/// @return  Wrong kinds and bounds.
[[nodiscard]] std::vector<Error> read_parameters(Scenario& scenario, const GivenValues& given);

/// One error of many, a line for each. @pre There is one.
[[nodiscard]] Error joined(const std::vector<Error>& errors);
/// `no policy "slow"; try: flyball list policies`
[[nodiscard]] Error unknown(const std::string& what,
                            const std::string& name,
                            const std::string& list);
/// A plug-in's parameters, checked; what is wrong with them comes in one error.
[[nodiscard]] Result<Parameters> resolved(const std::string& owner,
                                          const std::vector<ParameterSpec>& specs,
                                          const ParameterValues& given);

/// The mapper that the scenario names, configured.
///
/// @error `not_found`, or `invalid_input` with a sentence for each wrong parameter.
[[nodiscard]] Result<std::unique_ptr<Mapper>> make_mapper(const KernelSettings& kernels);
/// The same for the localizer.
[[nodiscard]] Result<std::unique_ptr<Localizer>> make_localizer(const KernelSettings& kernels);
/// The detector that the scenario names, started.
///
/// @error `not_found` (no such detector; weights, cascades), `invalid_input` (a parameter).
[[nodiscard]] Result<std::unique_ptr<Detector>> make_detector(const Scenario& scenario);

}  // namespace flyball
