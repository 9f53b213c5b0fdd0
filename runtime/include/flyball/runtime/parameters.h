// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Named, bounded settings of a plug-in (a policy, a world generator), declared by the plug-in
/// itself, so that unknown names and impossible values are found before anything runs.

#include "flyball/runtime/result.h"

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace flyball {

using ParameterValue = std::variant<double, std::string>;

/// Declares one parameter. A number has bounds; a text has choices (none: any text).
struct ParameterSpec {
  std::string name;  ///< With its unit as suffix: `spread_m`.
  ParameterValue fallback;
  double min{};
  double max{};
  std::string description;
  std::vector<std::string> choices{};
  bool required{};  ///< There is no default: `fallback` is an example.
};

class Parameters {
 public:
  /// Every declared parameter with its given value or its default.
  ///
  /// @param owner  For messages: `world "forest"`.
  /// @error One per unknown or missing name, wrong type and value out of bounds: all of them are
  /// returned.
  static std::variant<Parameters, std::vector<Error>> resolve(
      const std::string& owner,
      const std::vector<ParameterSpec>& specs,
      const std::map<std::string, ParameterValue>& given);

  /// @pre `name` was declared as a number.
  [[nodiscard]] double number(const std::string& name) const;
  /// @pre `name` was declared as a text.
  [[nodiscard]] const std::string& text(const std::string& name) const;
  [[nodiscard]] const std::map<std::string, ParameterValue>& values() const { return values_; }

 private:
  std::map<std::string, ParameterValue> values_;
};

}  // namespace flyball
