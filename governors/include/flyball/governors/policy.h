// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The bare decision rule. It may be wrong; PolicyGovernor makes it safe.

#include "flyball/runtime/governor.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"

#include <optional>
#include <vector>

namespace flyball {

class Policy {
 public:
  Policy() = default;
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;
  virtual ~Policy() = default;

  /// What a preset may set.
  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const = 0;
  /// Called once, before the first decision.
  /// @error `invalid_input` when parameters contradict each other or the knobs.
  virtual Status start(const Parameters& given, const KnobSettings& knobs) = 0;
  /// How often it wants to be asked; empty: as often as the scenario says. Asked once, when
  /// started.
  [[nodiscard]] virtual std::optional<Duration> period() const { return std::nullopt; }
  /// The wish for the time until the next decision. Must not block or allocate.
  [[nodiscard]] virtual Decision decide(const Observation& seen) noexcept = 0;
};

}  // namespace flyball
