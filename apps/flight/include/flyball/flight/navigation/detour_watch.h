// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether a map of smaller cells may show a shorter path than the one that was found.

#include "flyball/flight/navigation/known_path.h"

#include <limits>
#include <optional>

namespace flyball {

/// Whether cells are smaller than others by more than rounding, by the length of their edges.
[[nodiscard]] bool are_smaller_cells(double cells_m, double than_m);

/// In large cells a door may be closed, so that the path that is found is a way around. This class
/// knows in which cells was searched and which were waited for, and it keeps a long detour back
/// while smaller cells are to come. Cells are given by the length of their edges.
class DetourWatch {
 public:
  /// The way to a new goal begins.
  void begin();
  /// A path has been searched for in a map of such cells.
  void searched(double cells_m) { searched_m_ = cells_m; }
  /// A map has come. @return  Whether its cells are smaller than those of the last search; true
  /// once for each size, because one search shows whether there is a shorter path.
  [[nodiscard]] bool shows_more(double cells_m);
  /// Whether these cells, which the governor asks for, are smaller than those of the last search
  /// and than all that a detour was held back for on the way to this goal.
  [[nodiscard]] bool may_await(double asked_m) const;
  /// What the last search found is not flown before a map of the cells that are asked for is there.
  void hold_back(KnownPath detour, double asked_m);
  [[nodiscard]] bool holds_back() const { return held_back_.has_value(); }
  /// Whether a search in a map of such cells would find again what is held back.
  [[nodiscard]] bool is_found_again(double cells_m) const;
  /// What was held back. @pre `holds_back()`
  [[nodiscard]] KnownPath take();
  /// Another path is flown.
  void drop() { held_back_.reset(); }

 private:
  struct HeldBack {
    KnownPath path{};
    double cells_m{};  ///< In which it was found.
  };
  double searched_m_{};
  double awaited_m_{std::numeric_limits<double>::infinity()};
  std::optional<HeldBack> held_back_{};
};

}  // namespace flyball
