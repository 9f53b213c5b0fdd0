// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Policies against each other over several worlds: who is better, by how much, and how sure that
/// is.

#include "flyball/studies/comparison.h"
#include "flyball/studies/hindsight.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// A policy that is measured by another one: by the same application at another clock, say.
struct PolicyPair {
  std::string policy;
  std::string to;
};

/// A policy less another one, seed by seed, over the seeds where both succeed. Negative is better.
struct PairedDifference {
  std::string policy;
  std::string to;
  int pairs{};
  int wins{};  ///< Pairs in which it took less energy.
  std::optional<MedianInterval> time_s{};
  std::optional<MedianInterval> energy_j{};
  std::optional<MedianInterval> battery_percent{};
  std::optional<MedianInterval> energy_percent{};    ///< Of the other one's energy.
  std::optional<MedianInterval> computer_percent{};  ///< The computer's alone, of the other's.
  /// `mission_energy less two_level`
  [[nodiscard]] std::string name() const { return policy + " less " + to; }
};

/// How a policy decided; medians over its succeeded flights.
struct DecisionFigures {
  std::string policy;
  std::optional<MedianInterval> overrun_percent{};  ///< Maps later than their bound.
  std::optional<MedianInterval> budget_use{};       ///< Latency over its bound.
  /// 99th percentile, on the host: in the page only, since tables are the same wherever one flies.
  std::optional<MedianInterval> decision_us{};
  std::optional<MedianInterval> over_bound{};      ///< Energy over what any flight takes at least.
  std::optional<std::uint64_t> throttle_events{};  ///< In all; empty: its heat is not known.
};

/// The latency bounds that a policy stated at one level of map resolution, in all its flights.
struct BoundFigures {
  std::string policy;
  double resolution_m{};
  std::uint64_t issued{};
  std::uint64_t late{};
  std::optional<double>
      most_late{};  ///< The share asked for and the stated slack; empty: unstated.
  [[nodiscard]] double late_percent() const { return percent(static_cast<double>(late)); }
  [[nodiscard]] std::optional<double> most_percent() const {
    return most_late ? std::optional{std::min(100.0, percent(*most_late))} : std::nullopt;
  }

 private:
  [[nodiscard]] double percent(double count) const {
    return issued == 0 ? 0.0 : 100.0 * count / static_cast<double>(issued);
  }
};

/// What a mission takes at least [J], by world and seed; see energy_bound.h.
using KnownBounds = std::map<std::pair<std::string, std::uint64_t>, double>;

struct WorldResult {
  Comparison comparison{};
  std::vector<PairedDifference> differences{};  ///< Without the first policy.
  std::vector<PairedDifference> pairs{};        ///< Those that were asked for, and flew here.
  std::vector<DecisionFigures> decisions{};     ///< In the order of the comparison's rows.
  std::vector<BoundFigures> latency_bounds{};   ///< Of policies that make some.
  std::optional<Hindsight> hindsight{};         ///< What the row `fixed_best` is; empty: no row.
  /// Whether one of the policies' energies is set against a bound.
  [[nodiscard]] bool has_bound() const;
  /// Whether one of the computers could have become too hot.
  [[nodiscard]] bool has_heat() const;
};

/// @param flights  World by world, as `compare_flights` wants them; a world is a scenario's name.
/// @param bounds   May be empty: then nothing is said of them.
/// @param pairs    Who is measured by whom, beside all others by the first one; may be empty.
[[nodiscard]] std::vector<WorldResult> tournament_of(const std::vector<Summary>& flights,
                                                     const KnownBounds& bounds = {},
                                                     const std::vector<PolicyPair>& pairs = {});

/// An array with one object for each world: that of `compare`, and `differences` beside `rows`.
[[nodiscard]] std::string to_json(const std::vector<WorldResult>& worlds);
[[nodiscard]] std::string to_text(const std::vector<WorldResult>& worlds);
/// One file without network: for each world its tables, one plot per quantity and energy over time.
/// @param summary  HTML that stands above the worlds.
[[nodiscard]] std::string tournament_page(const std::string& title,
                                          const std::vector<WorldResult>& worlds,
                                          const std::string& summary = {});

}  // namespace flyball
