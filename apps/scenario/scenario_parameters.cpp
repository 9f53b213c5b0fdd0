// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/scenario_parameters.h"

#include "flyball/kernels/detector.h"
#include "flyball/scenario/models.h"
#include "flyball/scenario/plugins.h"
#include "flyball/sim/world.h"

#include "scenario/scenario_keys.h"
#include <utility>

namespace flyball {
namespace {

constexpr const char* world_prefix = "world.";
constexpr const char* mapper_prefix = "kernels.mapper_parameters.";
constexpr const char* localizer_prefix = "kernels.localizer_parameters.";
constexpr const char* detector_prefix = "kernels.detector_parameters.";

template <class Plugin>
ParameterGroup group_of(const std::string& family, const std::string& name, const char* prefix) {
  ParameterGroup group;
  group.selector = prefix == world_prefix ? "world.generator" : "kernels." + family;
  group.prefix = prefix;
  group.owner = family + " \"" + name + "\"";
  if (const auto plugin = all_plugins().make<Plugin>(name)) {
    group.exists = true;
    group.specs = plugin->parameters();
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

template <class Plugin>
Result<std::unique_ptr<Plugin>> make_configured(const std::string& family,
                                                const std::string& name,
                                                const ParameterValues& given) {
  auto plugin = all_plugins().make<Plugin>(name);
  if (!plugin) {
    return unknown(family, name, "kernels");
  }
  const auto chosen = resolved(family + " \"" + name + "\"", plugin->parameters(), given);
  if (!chosen) {
    return chosen.error();
  }
  plugin->configure(*chosen);
  return plugin;
}

}  // namespace

std::vector<ParameterGroup> parameter_groups(const Scenario& scenario) {
  const KernelSettings& kernels = scenario.kernels;
  return {group_of<WorldGenerator>("world", scenario.world.generator, world_prefix),
          group_of<Mapper>("mapper", kernels.mapper, mapper_prefix),
          group_of<Localizer>("localizer", kernels.localizer, localizer_prefix),
          group_of<Detector>("detector", kernels.detector, detector_prefix)};
}

const ParameterValues& values_of(const Scenario& scenario, const ParameterGroup& group) {
  if (group.prefix == world_prefix) {
    return scenario.world.parameters;
  }
  if (group.prefix == mapper_prefix) {
    return scenario.kernels.mapper_parameters;
  }
  return group.prefix == localizer_prefix ? scenario.kernels.localizer_parameters
                                          : scenario.kernels.detector_parameters;
}

ParameterValues& values_of(Scenario& scenario, const ParameterGroup& group) {
  return const_cast<ParameterValues&>(  // NOLINT(*-const-cast): the scenario is not constant
      values_of(std::as_const(scenario), group));
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

Result<std::unique_ptr<Mapper>> make_mapper(const KernelSettings& kernels) {
  return make_configured<Mapper>("mapper", kernels.mapper, kernels.mapper_parameters);
}

Result<std::unique_ptr<Localizer>> make_localizer(const KernelSettings& kernels) {
  return make_configured<Localizer>("localizer", kernels.localizer, kernels.localizer_parameters);
}

Result<std::unique_ptr<Detector>> make_detector(const Scenario& scenario) {
  const std::string& name = scenario.kernels.detector;
  auto detector = all_plugins().make<Detector>(name);
  if (!detector) {
    return unknown("detector", name, "kernels");
  }
  const auto chosen = resolved("detector \"" + name + "\"", detector->parameters(),
                               scenario.kernels.detector_parameters);
  if (!chosen) {
    return chosen.error();
  }
  const Status started = detector->start(*chosen, [&scenario](const std::string& file) {
    return find_model(file, scenario.detector.models_folder);
  });
  if (!started) {
    return started.error();
  }
  return detector;
}

}  // namespace flyball
