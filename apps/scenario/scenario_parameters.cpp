// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/scenario_parameters.h"

#include "flyball/sim/world.h"

#include "scenario/kernel_choice.h"
#include "scenario/scenario_keys.h"

namespace flyball {
namespace {

ParameterGroup world_group(const Scenario& scenario) {
  const std::string& name = scenario.world.generator;
  ParameterGroup group{"world.generator", "world.", "world \"" + name + "\""};
  if (const auto generator = scenario.plugins.make<WorldGenerator>(name)) {
    group.exists = true;
    group.specs = generator->parameters();
  }
  return group;
}

ParameterGroup group_of(const FamilyChoice& family, const Scenario& scenario) {
  const KernelSettings& kernels = scenario.kernels;
  const std::string selector = "kernels." + family.name;
  ParameterGroup group{selector, selector + "_parameters.", family.owner(kernels)};
  group.of_kernel = family.parameters;
  if (const auto kernel = family.make(scenario.plugins, kernels.*family.kernel)) {
    group.exists = true;
    group.specs = kernel->parameters();
  }
  return group;
}

std::optional<Error> set_parameter(ParameterValues& values,
                                   const std::string& prefix,
                                   const ParameterSpec& spec,
                                   const GivenValue& value) {
  const std::string what =
      prefix + spec.name + " = " + value.text + " (" + value.origin + ") must be ";
  if (std::holds_alternative<double>(spec.fallback)) {
    const std::optional<double> number = as_number(value);
    if (!number) {
      const std::string unit = parts_of(spec.name).unit;
      return Error{ErrorCode::invalid_input,
                   what + "a number" + (unit.empty() ? "" : " in " + unit)};
    }
    values[spec.name] = *number;
  } else {
    const std::optional<std::string> text = as_text(value);
    if (!text) {
      return Error{ErrorCode::invalid_input, what + "a text"};
    }
    values[spec.name] = *text;
  }
  return std::nullopt;
}

std::vector<Error> take_parameters(ParameterValues& values,
                                   const ParameterGroup& group,
                                   const GivenValues& given) {
  std::vector<Error> errors;
  for (const ParameterSpec& spec : group.specs) {
    const auto found = given.find(group.prefix + spec.name);
    if (found == given.end()) {
      continue;
    }
    if (std::optional<Error> error = set_parameter(values, group.prefix, spec, found->second)) {
      errors.push_back(std::move(*error));
    }
  }
  return errors;
}

}  // namespace

std::vector<ParameterGroup> parameter_groups(const Scenario& scenario) {
  std::vector<ParameterGroup> groups{world_group(scenario)};
  for (const FamilyChoice& family : family_choices()) {
    groups.push_back(group_of(family, scenario));
  }
  return groups;
}

const ParameterValues& values_of(const Scenario& scenario, const ParameterGroup& group) {
  return group.of_kernel == nullptr ? scenario.world.parameters : scenario.kernels.*group.of_kernel;
}

ParameterValues& values_of(Scenario& scenario, const ParameterGroup& group) {
  return group.of_kernel == nullptr ? scenario.world.parameters : scenario.kernels.*group.of_kernel;
}

std::vector<Error> read_parameters(Scenario& scenario, const GivenValues& given) {
  std::vector<Error> errors;
  for (const ParameterGroup& group : parameter_groups(scenario)) {
    ParameterValues& values = values_of(scenario, group);
    for (Error& error : take_parameters(values, group, given)) {
      errors.push_back(std::move(error));
    }
    auto resolved = Parameters::resolve(group.owner, group.specs, values);
    if (const auto* wrong = std::get_if<std::vector<Error>>(&resolved)) {
      errors.insert(errors.end(), wrong->begin(), wrong->end());
    } else {
      values = std::get<Parameters>(resolved).values();
    }
  }
  return errors;
}

Error joined(const std::vector<Error>& errors) {
  Error all{ErrorCode::invalid_input, ""};
  for (const Error& error : errors) {
    all.message += (all.message.empty() ? "" : "\n") + error.message;
  }
  return all;
}

Error unknown(const std::string& what, const std::string& name, const std::string& list) {
  return {ErrorCode::not_found, "no " + what + " \"" + name + "\"; try: flyball list " + list};
}

Result<Parameters> resolved(const std::string& owner,
                            const std::vector<ParameterSpec>& specs,
                            const ParameterValues& given) {
  auto parameters = Parameters::resolve(owner, specs, given);
  if (const auto* errors = std::get_if<std::vector<Error>>(&parameters)) {
    return joined(*errors);
  }
  return std::get<Parameters>(std::move(parameters));
}

}  // namespace flyball
