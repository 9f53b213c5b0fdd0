// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a paper says, what we measure, and the rule that tells whether they agree.

#include "flyball/studies/statistics.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// A number that a paper prints. Numbers that only a picture of it shows are none.
struct PaperValue {
  double value{};
  std::string where{};  ///< In the paper.
};

/// A change that the paper prints in percent, as the ratio that we compare: -84 % is .16.
[[nodiscard]] PaperValue paper_change(double percent, const std::string& where);

/// A median over flights, or a number that was computed without any.
struct Measured {
  std::optional<MedianInterval> value{};  ///< Empty: no flight has it.
  int n{};                                ///< Flights or pairs of flights; 0: computed.
};

/// Without an interval.
[[nodiscard]] Measured computed(double value);

/// What the paper's number is for ours.
enum class PaperMatch : std::uint8_t { value, at_least, at_most };

/// A cause that was tested: the same measurement with one thing changed.
struct Cause {
  std::string changed{};  ///< What was changed, and how: `plans take no time`.
  Measured ours{};        ///< With that change.
};

/// One number of ours, and the paper's beside it.
struct Claim {
  std::string what{};
  std::string unit{};                 ///< Empty: a ratio.
  std::optional<PaperValue> paper{};  ///< Empty: a figure of ours.
  Measured ours{};
  PaperMatch match{PaperMatch::value};
  /// The value that means "no effect" (1 for a ratio). With it a number that is off can still have
  /// the paper's trend.
  std::optional<double> neutral{};
  /// Differences up to here are none, in the claim's unit: for values near zero, where a share of
  /// them is nothing.
  double slack{};
  std::vector<Cause> causes{};
};

enum class Verdict : std::uint8_t {
  reproduced,
  same_trend,
  not_reproduced,
  not_measured,  ///< No flight has the figure.
  ours           ///< The paper has no number.
};

[[nodiscard]] const char* to_string(Verdict verdict);

/// Reproduced: our median is within 25 % of the paper's number, or on the right side of it where it
/// is a limit. Same trend: it is on the same side of `neutral` as the paper's number, with its
/// whole interval.
[[nodiscard]] Verdict verdict_of(const Claim& claim);

/// The share of the gap between our number and the paper's, both as logarithms of ratios, that a
/// change closes: 1 closes all of it, a negative share widens it. Empty where one of the three
/// numbers is missing or not positive, or where there is no gap.
[[nodiscard]] std::optional<double> share_of_gap(const Claim& claim, const Cause& cause);

/// A sentence with the effect of each cause, the greatest first. Empty where none was tested.
[[nodiscard]] std::string cause_text(const Claim& claim);

/// `0.54 [0.51, 0.58], n 3`, or `-`.
[[nodiscard]] std::string measured_text(const Measured& measured, const std::string& unit);

}  // namespace flyball
