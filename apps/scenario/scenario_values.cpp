// SPDX-License-Identifier: BSD-3-Clause
// tested-in: scenario

#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"

#include "scenario/scenario_fields.h"
#include "scenario/scenario_keys.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

/// Overloads for `std::visit`.
template <class... F>
struct Cases : F... {
  using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;

std::string with_unit(double value, const std::string& unit) {
  return number_text(value) + (unit.empty() ? "" : " " + unit);
}

Error wrong(const ScenarioField& field, const GivenValue& given, const std::string& rule) {
  return {ErrorCode::invalid_input,
          field.key + " = " + given.text + " (" + given.origin + ") " + rule};
}

Error wrong_kind(const ScenarioField& field, const GivenValue& given, const std::string& kind) {
  const std::string unit = parts_of(field.key).unit;
  return wrong(field, given, "must be " + kind + (unit.empty() ? "" : " in " + unit));
}

Error out_of_range(const ScenarioField& field, const GivenValue& given) {
  const std::string unit = parts_of(field.key).unit;
  return wrong(field, given,
               "must be at least " + with_unit(field.min, unit) + " and at most " +
                   with_unit(field.max, unit));
}

std::optional<std::int64_t> as_integer(const GivenValue& given) {
  if (const auto* whole = std::get_if<std::int64_t>(&given.value)) {
    return *whole;
  }
  const std::optional<double> number = as_number(given);
  constexpr double exact = 9007199254740992.0;  // 2^53: above it not every integer is a double.
  if (number && std::floor(*number) == *number && std::abs(*number) <= exact) {
    return static_cast<std::int64_t>(*number);
  }
  return std::nullopt;
}

std::optional<Error> set_number(double& place,
                                const ScenarioField& field,
                                const GivenValue& given) {
  const std::optional<double> number = as_number(given);
  if (!number) {
    return wrong_kind(field, given, "a number");
  }
  if (*number < field.min || *number > field.max) {
    return out_of_range(field, given);
  }
  place = *number;
  return std::nullopt;
}

std::optional<Error> set_integer(int& place, const ScenarioField& field, const GivenValue& given) {
  const std::optional<std::int64_t> number = as_integer(given);
  if (!number) {
    return wrong_kind(field, given, "a whole number");
  }
  if (static_cast<double>(*number) < field.min || static_cast<double>(*number) > field.max) {
    return out_of_range(field, given);
  }
  place = static_cast<int>(*number);
  return std::nullopt;
}

std::optional<Error> set_seed(std::uint64_t& place,
                              const ScenarioField& field,
                              const GivenValue& given) {
  const std::optional<std::int64_t> number = as_integer(given);
  if (!number || *number < 0) {
    return wrong(field, given, "must be a whole number from 0 to 2^63 - 1");
  }
  place = static_cast<std::uint64_t>(*number);
  return std::nullopt;
}

std::optional<Error> set_flag(bool& place, const ScenarioField& field, const GivenValue& given) {
  if (const bool* flag = std::get_if<bool>(&given.value)) {
    place = *flag;
    return std::nullopt;
  }
  return wrong(field, given, "must be true or false");
}

std::optional<Error> set_text(std::string& place,
                              const ScenarioField& field,
                              const GivenValue& given) {
  const std::optional<std::string> text = as_text(given);
  if (!text) {
    return wrong_kind(field, given, "a text");
  }
  const auto& choices = field.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), *text) == choices.end()) {
    return wrong(field, given, "must be one of: " + listed(choices));
  }
  place = *text;
  return std::nullopt;
}

}  // namespace

std::optional<double> as_number(const GivenValue& given) {
  if (const auto* whole = std::get_if<std::int64_t>(&given.value)) {
    return static_cast<double>(*whole);
  }
  const double* number = std::get_if<double>(&given.value);
  return number != nullptr && std::isfinite(*number) ? std::optional{*number} : std::nullopt;
}

std::optional<std::string> as_text(const GivenValue& given) {
  if (const auto* text = std::get_if<std::string>(&given.value)) {
    return text->empty() ? std::nullopt : std::optional{*text};
  }
  const bool is_of_option = given.origin.rfind("--", 0) == 0;
  return is_of_option ? std::optional{given.text} : std::nullopt;
}

std::optional<Error> assign(Scenario& scenario,
                            const ScenarioField& field,
                            const GivenValue& given) {
  return std::visit(
      Cases{[&](double* (*at)(Scenario&)) { return set_number(*at(scenario), field, given); },
            [&](int* (*at)(Scenario&)) { return set_integer(*at(scenario), field, given); },
            [&](std::uint64_t* (*at)(Scenario&)) { return set_seed(*at(scenario), field, given); },
            [&](bool* (*at)(Scenario&)) { return set_flag(*at(scenario), field, given); },
            [&](std::string* (*at)(Scenario&)) { return set_text(*at(scenario), field, given); }},
      field.place);
}

std::optional<double> number_at(const Scenario& scenario, const std::string& key) {
  Scenario copy = scenario;  // As in `toml_value`.
  for (const ScenarioField& field : scenario_fields()) {
    if (field.key == key) {
      const auto* real = std::get_if<double* (*)(Scenario&)>(&field.place);
      const auto* whole = std::get_if<int* (*)(Scenario&)>(&field.place);
      return real != nullptr    ? std::optional{*(*real)(copy)}
             : whole != nullptr ? std::optional{1.0 * *(*whole)(copy)}
                                : std::nullopt;
    }
  }
  return std::nullopt;
}

std::string toml_value(const Scenario& scenario, const ScenarioField& field) {
  Scenario copy =
      scenario;  // The places are for writing; a copy spares a second table for reading.
  return std::visit(
      Cases{[&](double* (*at)(Scenario&)) { return number_text(*at(copy)); },
            [&](int* (*at)(Scenario&)) { return std::to_string(*at(copy)); },
            [&](std::uint64_t* (*at)(Scenario&)) { return std::to_string(*at(copy)); },
            [&](bool* (*at)(Scenario&)) { return std::string{*at(copy) ? "true" : "false"}; },
            [&](std::string* (*at)(Scenario&)) { return toml_text(*at(copy)); }},
      field.place);
}

std::string toml_text(const std::string& text) {
  constexpr std::string_view hex = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (code < 0x20U || code == 0x7fU) {
      quoted += "\\u00";
      quoted += hex[code >> 4U];
      quoted += hex[code & 15U];
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace flyball
