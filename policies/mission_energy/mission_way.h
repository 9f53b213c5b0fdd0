// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a mission's way allows to whoever searches for the least energy.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/resting.h"
#include "flyball/runtime/decision.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include "failed_plans.h"
#include "passability.h"
#include "sight.h"
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// - The coarsest cells that leave the narrowest gap ahead open (`Passability`).
/// - The price of a failed plan: in coarse cells one that is not found soon is not there, and a
///   long search for it would keep the vehicle standing; so it gets a small budget there, and how
///   often that happens is a price of such cells (`FailedPlans`).
/// - Sight: where the world ends what is known to be free, a longer range buys nothing.
/// - The mission's own limit of speed, at which latency is worth nothing, but to see farther ahead
///   still makes the way shorter.
///
/// A mapper with a lattice of cells keeps what was hit at its finest level, so finer cells are
/// there when they are asked for. Others start a map of their own: with them, what is narrow is
/// looked at from nearby only, and two levels are used. Nothing allocates after `make`.
class MissionWay {
 public:
  /// A policy adds them to its own.
  [[nodiscard]] static std::vector<ParameterSpec> parameters();
  /// @param owner  For messages: `policy "mission_energy"`.
  /// @error `invalid_input` when parameters contradict each other or the knobs.
  static Result<MissionWay> make(const std::string& owner,
                                 const Parameters& given,
                                 const KnobSettings& knobs);

  /// What the search goes through.
  [[nodiscard]] std::vector<SearchLevel> levels(double fine_s, double coarse_s) const;
  [[nodiscard]] const std::vector<double>& ranges_m() const { return ranges_m_; }
  /// Way per obstacle, for `EnergySearchSettings`.
  [[nodiscard]] double spacing_m() const;

  /// How long a map may take where latency buys no speed; see `Resting`.
  [[nodiscard]] std::optional<double> rests_s(const Observation& seen) {
    return resting_.allowed_s(seen);
  }
  [[nodiscard]] std::size_t rest_raised_by() const { return resting_.raised_by(); }
  /// The map as the scenario has it.
  [[nodiscard]] const MapSetting& home() const { return home_; }

  /// @param in_force  What the search has chosen last.
  [[nodiscard]] Surroundings look(const Observation& seen, const MapSetting& in_force);
  /// Of the next plan, with a map of this resolution [iterations].
  [[nodiscard]] double plan_budget(const Observation& seen, double resolution_m) const;
  /// This setting, with its plan's budget.
  [[nodiscard]] Decision wish(const Observation& seen, const MapSetting& setting) const;

  /// Whether the mapper has several levels in one map.
  [[nodiscard]] bool is_lattice() const { return is_lattice_; }
  /// Cells beyond this shut openings that nobody has seen yet.
  [[nodiscard]] double large_m() const { return large_m_; }
  [[nodiscard]] double body_m() const { return body_m_; }
  [[nodiscard]] double narrow_m_s() const { return narrow_m_s_; }
  [[nodiscard]] double near_m() const;

 private:
  MissionWay(const Parameters& given, const KnobSettings& knobs, bool is_lattice);
  void limit_lattice(const Observation& seen,
                     bool near,
                     const MapSetting& in_force,
                     Surroundings& around);
  [[nodiscard]] bool needs_finest(const Observation& seen, bool near, const MapSetting& in_force);
  void limit_two_levels(const Observation& seen,
                        bool near,
                        const MapSetting& in_force,
                        Surroundings& around) const;
  [[nodiscard]] Passability passability(const Parameters& given) const;
  [[nodiscard]] double fine_budget(const Observation& seen) const;

  bool is_lattice_;
  double least_range_m_;
  double narrow_m_s_;
  double patience_s_;
  double body_m_;
  double large_m_;
  double full_budget_;
  double coarse_budget_{};
  MapSetting home_;
  std::vector<double> levels_m_;  ///< Finest first.
  std::vector<double> ranges_m_{};
  Resting resting_;
  Passability passability_;
  Sight sight_;
  FailedPlans failed_{};
  bool seeks_door_{};  ///< A plan has failed before the narrow place that is near.
};

}  // namespace flyball
