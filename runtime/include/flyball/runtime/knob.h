// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a governor may turn: each knob has a name, a unit, legal values, a default, an owner.

#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

struct KnobSpec {
  std::string name;  ///< `map.resolution_m`
  std::string unit;
  std::string owner;            ///< Node, or `platform`, or `mission`.
  std::vector<double> legal{};  ///< Ascending; empty: every value in [min, max].
  double min{};
  double max{};
  double fallback{};
  std::string description{};
  /// Keeps its value at least this long; empty: as long as the governor says.
  std::optional<Duration> min_dwell{};
  /// What each of `legal` stands for, where values are numbers of things: `hog`, `haar`.
  std::vector<std::string> labels{};
  /// The knob that this one makes one setting with: where a change of that one is wished for, both
  /// change at once or both wait. Empty: it stands alone.
  std::string follows{};

  /// The legal value nearest to `wish`, the smaller of two equally near. @pre `wish` is finite.
  [[nodiscard]] double nearest(double wish) const;
  [[nodiscard]] bool is_legal(double value) const;
};

/// Whether a knob is declared as it must be: a name with a dot, unit, owner and description; finite
/// limits, legal values in ascending order within them, a legal default, a label for each legal
/// value or none; it does not follow itself.
///
/// @error `invalid_input`, with the first thing that is wrong.
[[nodiscard]] Status check_declaration(const KnobSpec& spec);

/// Values by knob name, kept for the specs that it was made from.
class KnobSettings {
 public:
  KnobSettings() = default;
  explicit KnobSettings(std::vector<KnobSpec> specs);

  [[nodiscard]] const std::vector<KnobSpec>& specs() const { return specs_; }
  /// Null when no knob has this name.
  [[nodiscard]] const KnobSpec* spec(std::string_view name) const;
  /// @pre The knob exists.
  [[nodiscard]] double value(std::string_view name) const;
  /// @error `not_found`, `invalid_input` (both name the way out); the value is unchanged.
  Status set(std::string_view name, double value);

 private:
  std::vector<KnobSpec> specs_;
  std::vector<double> values_;
};

}  // namespace flyball
