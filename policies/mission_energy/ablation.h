// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// `mission_energy` without one of its parts, which shows by flights what that part earns.

#include "flyball/governors/energy_search.h"
#include "flyball/runtime/board.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/parameters.h"

#include <cstdint>
#include <vector>

namespace flyball {

/// All that is known of a part that is left out stands here, so that the rule itself has no
/// branches for it: what the rule is told is changed, or what it tells the search. Nothing
/// allocates after construction.
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
  [[nodiscard]] EnergySearchSettings begins_with(EnergySearchSettings settings) const;

  /// What the search learns from, and what the limits look at.
  [[nodiscard]] Observation seen(Observation seen) const;
  /// Changes what the search may choose.
  void limit(Surroundings& around, const EnergySearch& search) const;
  /// Whether the top clock is kept also while the vehicle is idle.
  [[nodiscard]] bool keeps_top_clock() const { return part_ == Part::clock; }

 private:
  enum class Part : std::uint8_t {
    none,
    search,
    resolution,
    range,
    clock,
    latency_learning,
    gaps,
    visibility,
    ceiling,
    rotor_power,
    declared_zones,
    detour_prices,
    view_budgets,
    noise_limit,
    wide_first_bound
  };
  /// Leaves one setting in cruise: the largest cells that the limits allow, with gap_switch's range
  /// for them.
  static void leave_one(Surroundings& around, const EnergySearch& search);
  struct Named;
  static const std::vector<Named>& parts();
  Part part_{Part::none};
};

}  // namespace flyball
