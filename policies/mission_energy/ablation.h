// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// `mission_energy` without one of its parts, which shows by flights what that part earns.

#include "flyball/governors/learned_latency.h"
#include "flyball/runtime/board.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/parameters.h"

#include "map_rule.h"
#include <cstdint>
#include <vector>

namespace flyball {

/// All that is known of a part that is left out stands here, so that the rule itself has no
/// branches for it: what the rule is told is changed, or what it takes. Nothing allocates after
/// construction.
class Ablation {
 public:
  /// A text parameter `without`, whose choices are the parts; `flyball tournament --ablate` reads
  /// them from there.
  [[nodiscard]] static ParameterSpec parameter();

  /// @param given  With a value for `parameter()`.
  explicit Ablation(const Parameters& given);

  /// What the policy begins with.
  /// @param specs  The policy's own.
  [[nodiscard]] Parameters begins_with(const Parameters& given,
                                       const std::vector<ParameterSpec>& specs) const;
  [[nodiscard]] BoardModel begins_with(BoardModel board) const;
  [[nodiscard]] LearnedLatencySettings begins_with(LearnedLatencySettings settings) const;

  /// What the policy learns from and looks at.
  [[nodiscard]] Observation seen(Observation seen) const;
  /// The map that the policy takes.
  [[nodiscard]] MapSetting map(const MapRule& rule,
                               MapNeeds needs,
                               const LearnedLatency& latency) const;
  /// Whether no lower clock than the highest is taken.
  [[nodiscard]] bool keeps_top_clock() const { return part_ == Part::clock; }

 private:
  enum class Part : std::uint8_t {
    none,
    resolution,
    range,
    clock,
    latency_learning,
    gaps,
    ceiling,
    rotor_power,
    declared_zones,
    view_budgets,
    view_threads,
    noise_limit,
    wide_first_bound
  };
  struct Named;
  static const std::vector<Named>& parts();
  Part part_{Part::none};
};

}  // namespace flyball
