// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What each part of a policy earns: the policy without it against the whole policy, over all
/// worlds and seeds.

#include "flyball/records/summary.h"
#include "flyball/studies/statistics.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// A policy that flies without one of its parts.
struct AblatedPolicy {
  std::string part;    ///< `clock`
  std::string policy;  ///< `mission_energy_without_clock`, as the summaries say.
};

struct PartGain {
  std::string part;
  int pairs{};         ///< World and seed where both succeed.
  int only_whole{};    ///< Where only the whole policy succeeds, ...
  int only_without{};  ///< ... and where only the one without this part does.
  int differ{};        ///< Pairs whose energies differ by more than a tenth of a percent.
  /// What leaving the part out costs, of the whole policy's energy; negative: it saves so much.
  std::optional<MedianInterval> energy_percent{};
  std::optional<double> mean_percent{};  ///< The same; of geometric means.
  /// What is to be said of it in a word or two: of success where a sign test finds a difference
  /// (5 %), else of energy where its interval does.
  [[nodiscard]] std::string verdict() const;
};

/// In the order of `without`. Parts that did not fly have no pairs.
[[nodiscard]] std::vector<PartGain> part_gains(const std::vector<Summary>& flights,
                                               const std::string& whole,
                                               const std::vector<AblatedPolicy>& without);

[[nodiscard]] std::string to_text(const std::string& whole, const std::vector<PartGain>& gains);
/// An array with an object for each part.
[[nodiscard]] std::string to_json(const std::vector<PartGain>& gains);
/// A table for a page.
[[nodiscard]] std::string to_html(const std::string& whole, const std::vector<PartGain>& gains);

}  // namespace flyball
