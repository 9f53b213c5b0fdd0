// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// When the vehicle is idle: lower latency would not make it faster. Also how old a map may be
/// then.

#include "flyball/runtime/observation.h"

#include <cstddef>
#include <optional>

namespace flyball {

/// There are two cases. In one the vehicle waits: it hovers, or stands with its rotors off. In the
/// other it flies without a map, through space that is declared free. A policy asks once in each
/// decision.
class Idle {
 public:
  /// @param map_s  While the vehicle waits, a map may take so long [s], unless the mission says.
  explicit Idle(double map_s) : map_s_{map_s} {}

  /// How long a map may take [s]. Infinite in a flight without a map; empty while the vehicle is
  /// not idle, so that latency counts.
  [[nodiscard]] std::optional<double> allowed_s(const Observation& seen);
  /// By how many steps the clock must exceed the slowest one that seems fast enough. It is the
  /// number of decisions in this idle time before which a deadline was missed.
  [[nodiscard]] std::size_t raised_by() const { return raised_by_; }

 private:
  [[nodiscard]] std::optional<double> patience_s(const Observation& seen) const;

  double map_s_;
  std::optional<MissionTime> since_{};
  std::size_t raised_by_{};
};

}  // namespace flyball
