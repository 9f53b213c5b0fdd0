// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The one table of all settings of a scenario. Reading, `--set`, checking, printing and writing
/// all go through it, so that a new setting is one new line.

#include "flyball/scenario/scenario.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace flyball {

/// Where a value lives in a scenario; its type is the kind of the setting.
using FieldPlace = std::variant<double* (*)(Scenario&),
                                int* (*)(Scenario&),
                                std::uint64_t* (*)(Scenario&),
                                bool* (*)(Scenario&),
                                std::string* (*)(Scenario&)>;

/// `&at<&Scenario::map, &MapSettings::range_m>` is the place of `map.range_m`.
template <auto section, auto value>
auto* at(Scenario& scenario) {
  return &(scenario.*section.*value);
}

struct ScenarioField {
  std::string key;  ///< `map.range_m`; the unit is its suffix.
  FieldPlace place;
  double min{};  ///< Numbers only; both ends are legal.
  double max{};
  std::string description;
  std::vector<std::string> choices{};  ///< Texts only; none: any text, or checked elsewhere.
};

/// In the order in which they are printed. The world's own parameters are declared by its
/// generator.
[[nodiscard]] std::vector<ScenarioField> scenario_fields();

/// The value that was given for a key, and where it was given.
struct GivenValue {
  std::variant<double, std::int64_t, bool, std::string> value;
  std::string origin;  ///< `mine.toml:12` or an option: `--set`, `--policy`.
  std::string text;    ///< As written, for messages and for texts given by options.
};

/// Sets the field. Returns one sentence when the value has the wrong type or is out of range.
[[nodiscard]] std::optional<Error> assign(Scenario& scenario,
                                          const ScenarioField& field,
                                          const GivenValue& given);
/// The value as a real number; integers count, too. Empty when it is not a finite number.
[[nodiscard]] std::optional<double> as_number(const GivenValue& given);
/// The value as a text that is not empty; `--set name=079` on the command line is a text, too.
[[nodiscard]] std::optional<std::string> as_text(const GivenValue& given);

/// The number of a setting; empty where no setting has this key, or it is not a number.
[[nodiscard]] std::optional<double> number_at(const Scenario& scenario, const std::string& key);
/// The field's value as TOML writes it.
[[nodiscard]] std::string toml_value(const Scenario& scenario, const ScenarioField& field);
[[nodiscard]] std::string toml_text(const std::string& text);

}  // namespace flyball
