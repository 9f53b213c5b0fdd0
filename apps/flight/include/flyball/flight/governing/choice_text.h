// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A governor's decision in words that say it bit for bit.

#include "flyball/governors/policy_governor.h"

#include <map>
#include <optional>
#include <string>

namespace flyball {

/// Bit for bit: NaN is equal to itself, 0 and -0 are not equal.
[[nodiscard]] bool have_same_bits(double a, double b);

/// `map.resolution_m=0.15 cpu.cores=4`; numbers with 17 digits.
[[nodiscard]] std::string settings_text(const Decision& decision);
/// Reason, wish, answer and step of the fallback of the last decision.
[[nodiscard]] std::string choice_text(const PolicyGovernor& governor, const Decision& answer);

/// The answer in the words of `choice_text`, as values by knob; nothing when it is no such text.
[[nodiscard]] std::optional<std::map<std::string, double>> settings_of(const std::string& choice);

/// Tells a decision that is as the last one was, without putting it into words.
class ChoiceMemory {
 public:
  /// False when wish, answer, reason and fallback are as at the last call.
  [[nodiscard]] bool is_new(const PolicyGovernor& governor, const Decision& answer);

 private:
  Decision wished_{};
  Decision answer_{};
  Fallback fallback_{};
  bool has_one_{};
};

}  // namespace flyball
