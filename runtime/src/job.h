// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One job on the modeled computer: how far it is, and what it will say when it ends.

#include "flyball/runtime/executor.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace flyball {

/// Which servers a job waits for.
enum class ComputePlace : std::uint8_t { board, gpu, edge };

struct Job {
  std::uint64_t id{};  ///< In the order of release.
  ComputePlace place{ComputePlace::board};
  bool has_started{};
  bool is_in_transit{};  ///< Its inputs or its outputs are on the link.
  bool is_done{};        ///< On the edge computer, and its outputs are on the way.
  bool is_told_to_stop{};
  JobRecord record{};

  double left{1.0};     ///< Share of the work that is still to do.
  double one_core_s{};  ///< Time of the whole work on one core at the present clock.
  double shared{1.0};   ///< Share of that time in which several cores can work side by side.
  double share{};       ///< Cores granted now.
  double speed{};       ///< How many times faster than one core that is.
  double busy_s{};      ///< Time so far on the board's own cores.

  /// Only the newest end that was scheduled counts.
  std::uint64_t end_schedule{};
  bool has_end{};

  std::vector<std::pair<int, Message>> outputs{};
  std::vector<std::function<void(MissionTime)>> at_end{};

  void advance(double elapsed_s) {
    busy_s += place == ComputePlace::board ? share * elapsed_s : 0.0;
    left = one_core_s > 0.0 ? std::max(0.0, left - elapsed_s * speed / one_core_s) : 0.0;
  }
  /// @pre `speed > 0`.
  [[nodiscard]] Duration time_to_end() const {
    // A picosecond less, so that rounding in the last bit does not cost a whole nanosecond.
    constexpr double rounding_s = 1e-12;
    return from_seconds(std::max(0.0, left * one_core_s / speed - rounding_s));
  }
};

}  // namespace flyball
