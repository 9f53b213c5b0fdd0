// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The bare decision rule. It may be wrong; PolicyGovernor makes it safe.

#include "flyball/runtime/board.h"
#include "flyball/runtime/decision.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include <vector>

namespace flyball {

/// What only some policies can do besides stands in policy_abilities.h.
class Policy {
 public:
  Policy() = default;
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;
  virtual ~Policy() = default;

  /// What a preset may set.
  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const = 0;
  /// Called once, before the first decision.
  /// @param board  The computer that it will fly on; `{}` where nothing is known of it.
  /// @error `invalid_input` when parameters contradict each other or the knobs, or when something
  /// is missing that the policy cannot do without.
  virtual Status start(const Parameters& given,
                       const KnobSettings& knobs,
                       const BoardModel& board) = 0;
  /// The wish for the time until the next decision. Must not block or allocate.
  [[nodiscard]] virtual Decision decide(const Observation& seen) noexcept = 0;
};

}  // namespace flyball
