// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the runtime asks at each decision point: how should the knobs stand next?

#include "flyball/runtime/decision.h"
#include "flyball/runtime/observation.h"

namespace flyball {

/// The runtime applies the answer without checking it.
class Governor {
 public:
  Governor() = default;
  Governor(const Governor&) = delete;
  Governor& operator=(const Governor&) = delete;
  virtual ~Governor() = default;

  /// @post Every wish names an existing knob and a legal value of it.
  [[nodiscard]] virtual Decision decide(const Observation& seen) noexcept = 0;
};

}  // namespace flyball
