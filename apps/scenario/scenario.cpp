// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/scenario.h"

#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/files.h"

#include "scenario/scenario_check.h"
#include "scenario/scenario_edge.h"
#include "scenario/scenario_events.h"
#include "scenario/scenario_fields.h"
#include "scenario/scenario_keys.h"
#include "scenario/scenario_parameters.h"
#include "scenario/scenario_reader.h"
#include <algorithm>

namespace flyball {
namespace {

using Fields = std::vector<ScenarioField>;
using Groups = std::vector<ParameterGroup>;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Every key that this scenario may have, with those of its plug-ins.
std::vector<std::string> known_keys(const Fields& fields, const Groups& groups) {
  std::vector<std::string> keys;
  for (const ScenarioField& field : fields) {
    keys.push_back(field.key);
  }
  for (const ParameterGroup& group : groups) {
    for (const ParameterSpec& spec : group.specs) {
      keys.push_back(group.prefix + spec.name);
    }
  }
  return keys;
}

void assign_all(Scenario& scenario, const Fields& fields, ScenarioText& read) {
  for (const ScenarioField& field : fields) {
    const auto given = read.values.find(field.key);
    if (given == read.values.end()) {
      continue;
    }
    if (std::optional<Error> error = assign(scenario, field, given->second)) {
      read.errors.push_back(std::move(*error));
    }
  }
}

/// The parameters of a plug-in that does not exist are unknown, so only its name is an error.
bool is_of_unknown_plugin(const Groups& groups, const std::string& key) {
  return std::any_of(groups.begin(), groups.end(), [&](const ParameterGroup& group) {
    return !group.exists && key.rfind(group.prefix, 0) == 0;
  });
}

void report_unknown_keys(const Fields& fields, const Groups& groups, ScenarioText& read) {
  const std::vector<std::string> known = known_keys(fields, groups);
  for (const auto& [key, given] : read.values) {
    if (contains(known, key) || is_of_unknown_plugin(groups, key) || is_event_key(key)) {
      continue;
    }
    std::string sentence = "no setting \"" + key + "\" (" + given.origin + "); ";
    if (const std::string hint = suggest_key(key, known); !hint.empty()) {
      sentence += hint + " ";
    }
    sentence += "try: flyball config SCENARIO";
    read.errors.push_back({ErrorCode::invalid_input, std::move(sentence)});
  }
}

std::string toml_value(const ParameterValue& value) {
  const double* number = std::get_if<double>(&value);
  return number != nullptr ? number_text(*number) : toml_text(std::get<std::string>(value));
}

std::string toml_line(const std::string& name, const std::string& value) {
  return name + " = " + value + "\n";
}

/// Those of the plug-in that `selector` names, below it: in a section of the same first name they
/// are dotted keys.
std::string parameter_lines(const Scenario& scenario,
                            const Groups& groups,
                            const std::string& selector) {
  std::string lines;
  for (const ParameterGroup& group : groups) {
    if (group.selector == selector) {
      const std::string inside = group.prefix.substr(group.prefix.find('.') + 1);
      for (const auto& [name, value] : values_of(scenario, group)) {
        lines += toml_line(inside + name, toml_value(value));
      }
    }
  }
  return lines;
}

std::string origin_of(const std::string& key, const GivenValues& given) {
  const auto found = given.find(key);
  return found == given.end() ? "default" : found->second.origin;
}

/// A file's parameters belong to the kernel or world that it names. When an override names another
/// one, that one starts from its own defaults.
void drop_exchanged(const ScenarioText& file, const Groups& groups, GivenValues& given) {
  for (const ParameterGroup& group : groups) {
    const auto filed = file.values.find(group.selector);
    const auto chosen = given.find(group.selector);
    if (filed == file.values.end() || as_text(filed->second) == as_text(chosen->second)) {
      continue;
    }
    for (const auto& [key, value] : file.values) {
      const auto now = given.find(key);
      if (key.rfind(group.prefix, 0) == 0 && now->second.origin == value.origin) {
        given.erase(now);
      }
    }
  }
}

void append_parameters(const Scenario& scenario,
                       const Groups& groups,
                       const std::string& selector,
                       const GivenValues& given,
                       std::vector<ConfigEntry>& entries) {
  for (const ParameterGroup& group : groups) {
    for (const ParameterSpec& spec : group.specs) {
      if (group.selector == selector) {
        const std::string key = group.prefix + spec.name;
        entries.push_back({key, toml_value(values_of(scenario, group).at(spec.name)),
                           toml_value(spec.fallback), origin_of(key, given), spec.description});
      }
    }
  }
}

std::vector<ConfigEntry> entries_of(const Scenario& scenario,
                                    const Fields& fields,
                                    const GivenValues& given) {
  const Scenario defaults;
  const Groups groups = parameter_groups(scenario);
  std::vector<ConfigEntry> entries;
  for (const ScenarioField& field : fields) {
    entries.push_back({field.key, toml_value(scenario, field), toml_value(defaults, field),
                       origin_of(field.key, given), field.description});
    append_parameters(scenario, groups, field.key, given, entries);
  }
  for (ConfigEntry& entry : event_entries(scenario)) {
    entry.origin = origin_of(entry.key, given);
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace

std::variant<LoadedScenario, std::vector<Error>> load_scenario(
    const std::string& name_or_path,
    const std::vector<std::string>& overrides,
    const Plugins& plugins) {
  return load_overridden_scenario(name_or_path, of_set(overrides), plugins);
}

std::vector<Override> of_set(const std::vector<std::string>& keys_and_values) {
  std::vector<Override> overrides;
  overrides.reserve(keys_and_values.size());
  for (const std::string& one : keys_and_values) {
    overrides.push_back({one});
  }
  return overrides;
}

std::variant<LoadedScenario, std::vector<Error>> load_overridden_scenario(
    const std::string& name_or_path,
    const std::vector<Override>& overrides,
    const Plugins& plugins) {
  const Result<std::string> file = find_shipped("scenarios", name_or_path);
  if (!file) {
    return std::vector<Error>{file.error()};
  }
  const ScenarioText filed = read_scenario_file(*file);
  ScenarioText read = filed;
  for (const Override& override : overrides) {
    read_override(override, read);
  }
  const Fields fields = scenario_fields();
  Scenario scenario;
  scenario.plugins = plugins;
  assign_all(scenario, fields, read);
  drop_exchanged(filed, parameter_groups(scenario), read.values);
  report_unknown_keys(fields, parameter_groups(scenario), read);
  for (const auto& check : {read_parameters(scenario, read.values),
                            read_events(scenario, read.values), check_names(scenario, read.values),
                            check_map(scenario, read.values), check_edge(scenario, read.values)}) {
    read.errors.insert(read.errors.end(), check.begin(), check.end());
  }
  if (!read.errors.empty()) {
    return std::move(read.errors);
  }
  std::vector<ConfigEntry> entries = entries_of(scenario, fields, read.values);
  return LoadedScenario{std::move(scenario), std::move(entries)};
}

std::string to_toml(const Scenario& scenario) {
  const Groups groups = parameter_groups(scenario);
  std::string text;
  std::string section;
  for (const ScenarioField& field : scenario_fields()) {
    const std::size_t dot = field.key.find('.');
    const std::string in = dot == std::string::npos ? "" : field.key.substr(0, dot);
    if (in != section) {
      section = in;
      text += "\n[" + section + "]\n";
    }
    text += toml_line(field.key.substr(dot + 1), toml_value(scenario, field));
    text += parameter_lines(scenario, groups, field.key);
  }
  return text + events_toml(scenario);
}

FlightSettings flight_settings(const Scenario& scenario) {
  FlightSettings settings;
  settings.name = scenario.name;
  settings.seed = scenario.seed;
  settings.mission = scenario.mission;
  settings.brake_lag = from_seconds(scenario.vehicle.brake_lag_s);
  settings.camera = scenario.camera;
  if (scenario.kernels.localizer == "gps") {
    settings.fix_error_m = std::hypot(scenario.gps.white_noise_m, scenario.gps.wander_m);
  }
  settings.kernels = scenario.kernels;
  settings.knobs = scenario.knobs;
  settings.has_edge = has_edge(scenario);
  settings.map = scenario.map;
  settings.planner = scenario.planner;
  settings.scan = scenario.scan;
  settings.explore = scenario.explore;
  settings.detector = scenario.detector;
  settings.photography = scenario.photography;
  settings.search = scenario.search;
  settings.watch = scenario.watch;
  settings.governor = scenario.governor;
  return settings;
}

}  // namespace flyball
