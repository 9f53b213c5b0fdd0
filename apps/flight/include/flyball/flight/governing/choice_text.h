// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A governor's decision as text that is exact to the bit.

#include "flyball/governors/policy_governor.h"

#include <map>
#include <optional>
#include <string>

namespace flyball {

/// Compares bits: NaN equals itself, 0 and -0 differ.
[[nodiscard]] bool have_same_bits(double a, double b);

/// `map.resolution_m=0.15 cpu.cores=4`; numbers with 17 digits.
[[nodiscard]] std::string settings_text(const Decision& decision);
/// Reason, wish, answer and step of the fallback of the last decision.
[[nodiscard]] std::string choice_text(const PolicyGovernor& governor, const Decision& answer);

/// A change of the fallback as an event tells it: `fallback hover: 6 deadlines were missed`.
[[nodiscard]] std::string fallback_text(Fallback step, const std::string& why);

/// What such an event says.
struct FallbackStep {
  std::string name{};  ///< As `to_string` has it.
  std::string why{};   ///< Empty where the fallback ends.
};
/// Nothing when the event is none of `fallback_text`.
[[nodiscard]] std::optional<FallbackStep> fallback_in(const std::string& event);

/// The answer in the words of `choice_text`, as values by knob; nothing when it is no such text.
[[nodiscard]] std::optional<std::map<std::string, double>> settings_of(const std::string& choice);

/// Tells whether a decision repeats the last one, without making its text.
class ChoiceMemory {
 public:
  /// False when wish, answer, reason and fallback are those of the last call.
  [[nodiscard]] bool is_new(const PolicyGovernor& governor, const Decision& answer);

 private:
  Decision wished_{};
  Decision answer_{};
  Fallback fallback_{};
  bool has_one_{};
};

}  // namespace flyball
