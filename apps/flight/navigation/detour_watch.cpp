// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/detour_watch.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <utility>

namespace flyball {

bool are_smaller_cells(double cells_m, double than_m) {
  constexpr double rounding_m = 1e-6;
  return cells_m < than_m - rounding_m;
}

void DetourWatch::begin() {
  drop();
  awaited_m_ = std::numeric_limits<double>::infinity();
}

bool DetourWatch::shows_more(double cells_m) {
  const bool shows = are_smaller_cells(cells_m, searched_m_);
  searched_m_ = shows ? cells_m : searched_m_;
  return shows;
}

bool DetourWatch::may_await(double asked_m) const {
  return are_smaller_cells(asked_m, std::min(searched_m_, awaited_m_));
}

void DetourWatch::hold_back(KnownPath detour, double asked_m) {
  held_back_ = HeldBack{std::move(detour), searched_m_};
  awaited_m_ = asked_m;
}

bool DetourWatch::is_found_again(double cells_m) const {
  return held_back_ && !are_smaller_cells(cells_m, held_back_->cells_m);
}

KnownPath DetourWatch::take() {
  FLYBALL_ASSERT(held_back_.has_value(), "no detour is held back");
  return std::exchange(held_back_, std::nullopt)->path;
}

}  // namespace flyball
