// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How often planning has led nowhere, in a row.

namespace flyball {

/// Counts failed searches, stalls and refused paths. A stall counts as a failed search even after
/// another path was found, because that path may end where the vehicle has stalled before; only a
/// vehicle that moves on has left its stalls behind.
class PlanFailures {
 public:
  /// Another goal: failed searches for the last one say nothing about it.
  void begin_goal() { failures_ = 0; }
  void search_failed() { ++failures_; }
  /// The path ended before unknown space of which the camera shows no more.
  void stalled() { failures_ = ++stalls_; }
  void path_found() { failures_ = stalls_; }
  /// The path came too late, or bent too sharply, to be joined.
  void path_refused() { ++refusals_; }
  void path_joined() { refusals_ = 0; }
  /// The vehicle flies: faster than it creeps before unknown space.
  void moved() {
    if (stalls_ > 0) {
      failures_ = stalls_ = 0;
    }
  }

  /// Failed searches and stalls: see NavigatorState::planner_failures.
  [[nodiscard]] int count() const { return failures_; }
  /// Paths that were refused since one was joined.
  [[nodiscard]] int refusals() const { return refusals_; }

 private:
  int failures_{};
  int stalls_{};
  int refusals_{};
};

}  // namespace flyball
