// SPDX-License-Identifier: BSD-3-Clause
#include "view_budget.h"

#include <algorithm>
#include <cmath>

namespace flyball {

ViewBudget::ViewBudget(double half_nodes) : half_nodes_{half_nodes} {
  constexpr double usually_in_all_else = 25.0;  // Measured: six seconds, and .25 s a node.
  nodes_ = best_nodes(usually_in_all_else);
}

double ViewBudget::best_nodes(double nodes_in_all_else) const {
  return std::max(1.0, std::round(std::sqrt(half_nodes_ * nodes_in_all_else)));
}

// A job's load counts when it ends, so a decision that sees some comes right after a search.
void ViewBudget::note(const Observation& seen) {
  const StageUse& search = seen.stage(Stage::explore);
  const double search_s = to_seconds(search.latency);
  if (!(search.load > 0.0) || search_s <= 0.0) {
    return;
  }
  if (!first_over_) {
    first_over_ = seen.now;
    return;
  }
  searching_s_ += search_s;
  searched_nodes_ += nodes_;
  searches_ += 1.0;
  const double else_s =
      std::max(0.0, to_seconds(seen.now - *first_over_) - searching_s_) / searches_;
  const double node_s = searching_s_ / searched_nodes_;
  nodes_ = best_nodes(else_s / node_s);
}

}  // namespace flyball
