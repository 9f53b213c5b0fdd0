// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Finds the parameters with which a policy uses the least energy, by a race between all
/// combinations.

#include "flyball/records/summary.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include <map>
#include <string>
#include <vector>

namespace flyball {

/// The values to try for one parameter.
struct TriedParameter {
  std::string name;
  std::vector<double> values{};
};

/// Reads `range_m=7,15,25`.
/// @error `invalid_input` for anything else, and for a value that comes twice.
[[nodiscard]] Result<TriedParameter> read_tried(const std::string& text);

/// Reads several of them.
/// @error Those of `read_tried`, and `invalid_input` for a parameter that comes twice.
[[nodiscard]] Result<std::vector<TriedParameter>> read_all_tried(
    const std::vector<std::string>& texts);

/// One combination of values, and its flights so far.
struct Candidate {
  std::map<std::string, double> parameters{};
  std::vector<Summary> flights{};

  /// Also flights that safe settings brought home, because the policy had failed: they say nothing
  /// of the parameters.
  [[nodiscard]] int failures() const;
  /// Over the other flights; 0 without one.
  [[nodiscard]] double mean_energy_j() const;
  /// The same.
  [[nodiscard]] double median_energy_j() const;
};

/// Every combination of the values; without parameters a single empty one.
[[nodiscard]] std::vector<Candidate> combinations(const std::vector<TriedParameter>& tried);

/// Fewer failures first, then less energy. @pre Both flew the same seeds.
[[nodiscard]] bool is_better(const Candidate& a, const Candidate& b);

/// Successive halving (Jamieson and Talwalkar 2016, arXiv 1502.07943): each round flies twice as
/// many seeds with the better half of what is left.
struct TuningRound {
  std::size_t seeds{};       ///< All that have flown by its end, from the front of the list.
  std::size_t candidates{};  ///< That fly in it.
};
/// @pre Both are positive. The last round flies all seeds, with at least two candidates if there
///      are two.
[[nodiscard]] std::vector<TuningRound> tuning_rounds(std::size_t candidates, std::size_t seeds);

/// The preset as a file.
[[nodiscard]] std::string preset_text(const std::string& policy,
                                      const std::string& description,
                                      const std::map<std::string, ParameterValue>& parameters);
[[nodiscard]] std::string preset_text(const std::string& policy,
                                      const std::string& description,
                                      const Candidate& candidate);
/// `range_m=7 resolution_m=0.15`
[[nodiscard]] std::string parameters_text(const Candidate& candidate);

/// The candidates, best first, as a table for a terminal; below it whether the policy failed.
[[nodiscard]] std::string to_text(const std::string& policy, const std::vector<Candidate>& ranked);
[[nodiscard]] std::string to_json(const std::string& scenario,
                                  const std::string& policy,
                                  const std::vector<Candidate>& ranked);

}  // namespace flyball
