// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The best single setting of a world in hindsight: the static opponent that knows the seeds it is
/// measured on. A policy that turns knobs in flight is worth something where it beats that one.

#include "flyball/runtime/knob.h"
#include "flyball/studies/tuning.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// A parameter of the policy `fixed`, the knob that it sets, and the values that are flown first.
struct GridAxis {
  std::string parameter;
  KnobSpec knob{};
  std::vector<double> values{};  ///< Ascending.
  double step{2.0};  ///< Beyond them, a knob without a list of values goes on by this factor.

  /// The next value above or below; empty: the knob ends here.
  [[nodiscard]] std::optional<double> next(double value, bool upwards) const;
};

/// Cells, range and planner budget, as far as the knobs of a mission allow: at least 24 settings
/// where its mapper has three sizes of cells or more.
/// @error `not_found`: the mission has no such knob.
[[nodiscard]] Result<std::vector<GridAxis>> hindsight_grid(const KnobSettings& knobs);
[[nodiscard]] std::vector<Candidate> settings_of(const std::vector<GridAxis>& grid);
/// The settings that differ from this one by one step along one axis, also beyond the grid.
[[nodiscard]] std::vector<Candidate> neighbours_of(const std::vector<GridAxis>& grid,
                                                   const Candidate& setting);

/// More successes first, then the lower median energy. @pre Both flew the same seeds.
[[nodiscard]] bool is_better_in_hindsight(const Candidate& a, const Candidate& b);
/// Whether the rest of its flights may be left out: it has failed more often than the best one did
/// with all seeds, or took a tenth more energy with each of at least two seeds.
/// @param flown  Its flights so far are with the first of the best one's seeds.
[[nodiscard]] bool has_lost(const Candidate& flown, const Candidate& best);

/// What was found in one world.
struct Hindsight {
  std::string setting{};               ///< `planner_budget=4000 range_m=7 resolution_m=0.15`
  std::string preset{};                ///< The file of that setting, which flies it as a policy.
  std::size_t tried{};                 ///< Settings that were flown, with at least one seed.
  std::size_t on_grid{};               ///< Those among them with which the search began.
  std::vector<std::string> borders{};  ///< A sentence for each axis on whose border the best lies.
  [[nodiscard]] std::string text() const;
};

/// @param flown  All settings that were flown; those that were dropped among them.
[[nodiscard]] Hindsight told_in_hindsight(const std::vector<GridAxis>& grid,
                                          const Candidate& best,
                                          const std::vector<Candidate>& flown);

}  // namespace flyball
