// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// When latency buys no speed, and how old a map may be then.

#include "flyball/runtime/observation.h"

#include <cstddef>
#include <optional>

namespace flyball {

/// Two cases are known: the vehicle waits (it hovers, or stands with its rotors off), and it flies
/// through space that is declared free, without any map. A policy asks once per decision.
class Resting {
 public:
  /// @param map_s  While it waits, a map in so long is soon enough [s].
  explicit Resting(double map_s) : map_s_{map_s} {}

  /// How long a map may take [s]; infinite where none is made; empty where latency counts.
  [[nodiscard]] std::optional<double> allowed_s(const Observation& seen);
  /// Clocks by which the slowest one that seems enough must be exceeded: a deadline was missed at
  /// so many, in this rest.
  [[nodiscard]] std::size_t raised_by() const { return raised_by_; }

 private:
  [[nodiscard]] std::optional<double> patience_s(const Observation& seen) const;

  double map_s_;
  std::optional<MissionTime> since_{};
  std::size_t raised_by_{};
};

}  // namespace flyball
