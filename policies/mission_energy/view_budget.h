// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How long a vehicle that explores searches for its next view.

#include "flyball/runtime/observation.h"
#include "flyball/runtime/time.h"

#include <optional>

namespace flyball {

/// A view costs the search for it and all else until the next search: a plan, the flight there, a
/// stop and a map. Of what the best view would show, the best of n random ones shows a share of
/// about n / (n + k). A search of n nodes at c seconds each, with T seconds of all else, shows the
/// most per second at n = sqrt(k T / c). Both times are measured in flight, so a faster computer,
/// or a higher clock, gets more nodes. What a search takes beside its nodes counts as theirs, which
/// makes n smaller than it should be. Until two searches are over, T / c is taken to be as in an
/// office on a TX2. Nothing allocates.
class ViewBudget {
 public:
  /// @param half_nodes  k: with so many nodes a view shows half of what the best one would.
  explicit ViewBudget(double half_nodes);

  void note(const Observation& seen);
  /// Of the next search.
  [[nodiscard]] double nodes() const { return nodes_; }

 private:
  [[nodiscard]] double best_nodes(double nodes_in_all_else) const;

  double half_nodes_;
  double nodes_;
  std::optional<MissionTime> first_over_{};  ///< From here on, time is counted.
  double searching_s_{};
  double searched_nodes_{};
  double searches_{};
};

}  // namespace flyball
