// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/parameters.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

namespace flyball {

namespace {

std::string names_of(const std::vector<ParameterSpec>& specs) {
  const std::string names = listed(specs, [](const ParameterSpec& spec) { return spec.name; });
  return names.empty() ? "it has none" : "it has: " + names;
}

/// What is wrong with a value, as the end of a sentence; nothing when it is fine.
std::optional<std::string> fault_of(const ParameterSpec& spec, const ParameterValue& value) {
  if (value.index() != spec.fallback.index()) {
    return std::holds_alternative<double>(spec.fallback) ? "must be a number" : "must be a text";
  }
  if (const double* number = std::get_if<double>(&value)) {
    const bool inside = *number >= spec.min && *number <= spec.max;  // false for NaN
    return inside
               ? std::nullopt
               : std::optional{short_number_text(*number) + " is not within " +
                               short_number_text(spec.min) + " to " + short_number_text(spec.max)};
  }
  const auto& text = std::get<std::string>(value);
  const auto& choices = spec.choices;
  if (choices.empty() || std::find(choices.begin(), choices.end(), text) != choices.end()) {
    return std::nullopt;
  }
  return "\"" + text + "\" is none of: " + listed(choices);
}

/// What is wrong with how parameters were declared, by a plug-in that may be anyone's.
std::vector<Error> faults_of_declaration(const std::string& owner,
                                         const std::vector<ParameterSpec>& specs) {
  std::vector<Error> errors;
  std::set<std::string> names;
  for (const ParameterSpec& spec : specs) {
    const std::string start = owner + " declares \"" + spec.name + "\" ";
    if (!names.insert(spec.name).second) {
      errors.push_back({ErrorCode::invalid_input, start + "twice"});
    }
    if (!std::holds_alternative<double>(spec.fallback)) {
      continue;
    }
    if (!(spec.min <= spec.max)) {  // true for NaN
      errors.push_back(
          {ErrorCode::invalid_input, start + "from " + short_number_text(spec.min) + " to " +
                                         short_number_text(spec.max) +
                                         "; its minimum must not be above its maximum"});
    } else if (std::isnan(std::get<double>(spec.fallback))) {
      errors.push_back({ErrorCode::invalid_input, start + "with a default that is no number"});
    }
  }
  return errors;
}

}  // namespace

std::variant<Parameters, std::vector<Error>> Parameters::resolve(
    const std::string& owner,
    const std::vector<ParameterSpec>& specs,
    const std::map<std::string, ParameterValue>& given) {
  if (auto faults = faults_of_declaration(owner, specs); !faults.empty()) {
    return faults;
  }
  Parameters resolved;
  for (const ParameterSpec& spec : specs) {
    resolved.values_.emplace(spec.name, spec.fallback);
  }
  std::vector<Error> errors;
  for (const ParameterSpec& spec : specs) {
    if (spec.required && given.count(spec.name) == 0) {
      errors.push_back({ErrorCode::invalid_input,
                        owner + ", " + spec.name + ": must be given; there is no default"});
    }
  }
  for (const auto& entry : given) {
    const std::string& name = entry.first;
    const auto spec = std::find_if(specs.begin(), specs.end(),
                                   [&name](const ParameterSpec& s) { return s.name == name; });
    if (spec == specs.end()) {
      std::string message = owner;
      message.append(" has no parameter \"").append(name).append("\"; ").append(names_of(specs));
      errors.push_back({ErrorCode::not_found, message});
    } else if (const auto fault = fault_of(*spec, entry.second)) {
      std::string message = owner;
      message.append(", ").append(name).append(": ").append(*fault);
      errors.push_back({ErrorCode::invalid_input, message});
    } else {
      resolved.values_[name] = entry.second;
    }
  }
  if (!errors.empty()) {
    return errors;
  }
  return resolved;
}

double Parameters::number(const std::string& name) const {
  const auto entry = values_.find(name);
  const bool ok = entry != values_.end() && std::holds_alternative<double>(entry->second);
  FLYBALL_ASSERT(ok, "no number \"%s\" was declared", name.c_str());
  return std::get<double>(entry->second);
}

const std::string& Parameters::text(const std::string& name) const {
  const auto entry = values_.find(name);
  const bool ok = entry != values_.end() && std::holds_alternative<std::string>(entry->second);
  FLYBALL_ASSERT(ok, "no text \"%s\" was declared", name.c_str());
  return std::get<std::string>(entry->second);
}

}  // namespace flyball
