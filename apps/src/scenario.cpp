// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/apps/scenario.h"

#include "flyball/apps/catalogue.h"
#include "flyball/apps/files.h"

#include "scenario_check.h"
#include "scenario_fields.h"
#include "scenario_keys.h"
#include "scenario_reader.h"
#include <algorithm>

namespace flyball {
namespace {

using Fields = std::vector<ScenarioField>;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Every key that this scenario may have, with those of its world.
std::vector<std::string> known_keys(const Scenario& scenario, const Fields& fields) {
  std::vector<std::string> keys;
  for (const ScenarioField& field : fields) {
    keys.push_back(field.key);
  }
  for (const ParameterSpec& spec : world_parameters(scenario)) {
    keys.push_back("world." + spec.name);
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
      read.errors.push_back(*std::move(error));
    }
  }
}

void report_unknown_keys(const Scenario& scenario, const Fields& fields, ScenarioText& read) {
  const std::vector<std::string> known = known_keys(scenario, fields);
  // Of a world that does not exist nobody knows the parameters: its name is the one error.
  const bool has_world = contains(world_names(), scenario.world.generator);
  for (const auto& [key, given] : read.values) {
    if (contains(known, key) || (!has_world && key.rfind("world.", 0) == 0)) {
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
  return number != nullptr ? toml_number(*number) : toml_text(std::get<std::string>(value));
}

std::string toml_line(const std::string& name, const std::string& value) {
  return name + " = " + value + "\n";
}

std::string parameter_lines(const WorldSettings& world) {
  std::string lines;
  for (const auto& [name, value] : world.parameters) {
    lines += toml_line(name, toml_value(value));
  }
  return lines;
}

std::string origin_of(const std::string& key, const GivenValues& given) {
  const auto found = given.find(key);
  return found == given.end() ? "default" : found->second.origin;
}

void append_world_entries(const Scenario& scenario,
                          const GivenValues& given,
                          std::vector<ConfigEntry>& entries) {
  for (const ParameterSpec& spec : world_parameters(scenario)) {
    const std::string key = "world." + spec.name;
    entries.push_back({key, toml_value(scenario.world.parameters.at(spec.name)),
                       toml_value(spec.fallback), origin_of(key, given), spec.description});
  }
}

std::vector<ConfigEntry> entries_of(const Scenario& scenario,
                                    const Fields& fields,
                                    const GivenValues& given) {
  const Scenario defaults;
  std::vector<ConfigEntry> entries;
  for (const ScenarioField& field : fields) {
    entries.push_back({field.key, toml_value(scenario, field), toml_value(defaults, field),
                       origin_of(field.key, given), field.description});
    if (field.key == "world.generator") {
      append_world_entries(scenario, given, entries);
    }
  }
  return entries;
}

}  // namespace

std::variant<LoadedScenario, std::vector<Error>> load_scenario(
    const std::string& name_or_path, const std::vector<std::string>& overrides) {
  const Result<std::string> file = find_shipped("scenarios", name_or_path);
  if (!file) {
    return std::vector<Error>{file.error()};
  }
  ScenarioText read = read_scenario_file(*file);
  for (const std::string& override : overrides) {
    read_override(override, read);
  }
  const Fields fields = scenario_fields();
  Scenario scenario;
  assign_all(scenario, fields, read);
  report_unknown_keys(scenario, fields, read);
  for (const auto& check :
       {read_world(scenario, read.values), check_names(scenario, read.values)}) {
    read.errors.insert(read.errors.end(), check.begin(), check.end());
  }
  if (!read.errors.empty()) {
    return std::move(read.errors);
  }
  std::vector<ConfigEntry> entries = entries_of(scenario, fields, read.values);
  return LoadedScenario{std::move(scenario), std::move(entries)};
}

std::string to_toml(const Scenario& scenario) {
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
    if (field.key == "world.generator") {
      text += parameter_lines(scenario.world);
    }
  }
  return text;
}

}  // namespace flyball
