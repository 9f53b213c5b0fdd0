// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What experiments found, as a table for a terminal, as CSV, and as one page.

#include "flyball/studies/sweep.h"

#include "experiments/framework/all_experiments.h"
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace flyball {

struct ExperimentResult {
  NamedExperiment named{};
  std::map<std::string, Sweep> sweeps{};          ///< By their names.
  std::map<std::string, std::string> commands{};  ///< That flies a sweep alone; by its name.
  Findings findings{};
  std::string trouble{};  ///< Why there are no findings; empty: there are.
};

/// Lets the experiment judge its flights.
void evaluate(ExperimentResult& result);

/// A row for each experiment: its first claim, and how many claims have which verdict.
[[nodiscard]] std::string to_text(const std::vector<ExperimentResult>& results);
/// A row for each claim of each experiment.
[[nodiscard]] std::string claims_csv(const std::vector<ExperimentResult>& results);
/// One file without network: a line for each experiment, what was ever fitted, then a section for
/// each experiment.
/// @param seeds  How many were asked for.
[[nodiscard]] std::string experiments_page(const std::vector<ExperimentResult>& results,
                                           std::size_t seeds);

/// The same claims, notes and commands as Markdown, without plots: for a page that stays in a tree.
[[nodiscard]] std::string experiments_markdown(const std::vector<ExperimentResult>& results);

/// `3 reproduced, 1 same trend`; claims without a number of the paper are left out.
[[nodiscard]] std::string verdict_counts(const Findings& findings);
/// `0.16` or `at least 4.5 x`; `-` where the paper has none.
[[nodiscard]] std::string paper_text(const Claim& claim);

}  // namespace flyball
