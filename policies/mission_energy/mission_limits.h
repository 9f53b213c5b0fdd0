// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which settings the path ahead allows in a search for the least energy.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/idle.h"
#include "flyball/runtime/board.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include "passability.h"
#include "visibility.h"
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Whether the mission makes progress by what its views show, not by the way that it flies.
[[nodiscard]] bool explores(const Observation& seen);

/// - The coarsest cells that leave the narrowest gap ahead open (`Passability`).
/// - Where narrow gaps are declared and plans keep failing, still smaller cells, if the mapper
/// takes
///   any: a door loses up to two cells of its width. Nowhere else, because they take long.
/// - The ceiling above the vehicle, which larger cells would fill down to it.
/// - The camera's noise: a level ends where noise is half a cell. A mapper with a lattice keeps all
///   hits, also those far off, so there noise stays below a quarter of the body's width, too. Where
///   wide gaps are seen there may be more noise.
/// - Visibility: where the world ends the view, a longer range gains nothing.
/// - The mission's own speed limit. There lower latency gains nothing, but a longer range still
///   makes the path shorter.
///
/// Nothing allocates after `make`.
class MissionLimits {
 public:
  /// A policy adds them to its own.
  [[nodiscard]] static std::vector<ParameterSpec> parameters();
  /// @param owner  For messages: `policy "mission_energy"`.
  /// @error `invalid_input` when parameters contradict each other or the knobs.
  static Result<MissionLimits> make(const std::string& owner,
                                    const Parameters& given,
                                    const KnobSettings& knobs,
                                    const VehicleModel& vehicle);

  /// The levels that the search compares.
  [[nodiscard]] std::vector<SearchLevel> levels(double fine_s, double coarse_s) const;
  [[nodiscard]] const std::vector<double>& ranges_m() const { return ranges_m_; }

  /// How long a map may take while the vehicle is idle; see `Idle`.
  [[nodiscard]] std::optional<double> idle_map_s(const Observation& seen) {
    return idle_.allowed_s(seen);
  }
  [[nodiscard]] std::size_t idle_raised_by() const { return idle_.raised_by(); }
  /// The map as the scenario has it.
  [[nodiscard]] const MapSetting& home() const { return home_; }

  /// @param in_force  The setting that the search has chosen last.
  [[nodiscard]] Surroundings look(const Observation& seen, const MapSetting& in_force);

  /// Larger cells may close openings that nobody has seen yet.
  [[nodiscard]] double large_m() const { return large_m_; }
  [[nodiscard]] double body_m() const { return body_m_; }
  [[nodiscard]] double narrow_m_s() const { return narrow_m_s_; }
  [[nodiscard]] double near_m() const;

 private:
  MissionLimits(const Parameters& given, const KnobSettings& knobs, const VehicleModel& vehicle);
  [[nodiscard]] double coarsest_m(const Observation& seen, bool near, const MapSetting& in_force);
  [[nodiscard]] bool needs_finest(const Observation& seen, bool near, const MapSetting& in_force);
  [[nodiscard]] bool needs_door_cells(const Observation& seen, bool near);
  [[nodiscard]] SearchLevel door_level(const std::vector<SearchLevel>& others) const;
  [[nodiscard]] Passability passability(const Parameters& given) const;
  [[nodiscard]] double under_ceiling_m(const Observation& seen) const;
  [[nodiscard]] double noise_free_m(double resolution_m) const;
  /// The range up to which the camera's noise is at most this. @pre The camera is known.
  [[nodiscard]] double range_with_m(double noise_m) const;
  /// The range up to which noise leaves gaps open like those that were seen; 0: none was.
  [[nodiscard]] double clear_range_m(const Observation& seen, bool near);
  /// For where noise may be larger than a level allows.
  void add_ranges_beyond(double most_m);
  /// For where the mission is slow: small cells take long, and the vehicle stops within a metre.
  void add_ranges_from(double slow_m);
  [[nodiscard]] double longest_m(const KnobSettings& knobs) const;

  bool keeps_hits_;  ///< The mapper does, at its finest level. Any other starts a new map.
  double least_range_m_;
  double narrow_m_s_;
  double patience_s_;
  double body_m_;
  double large_m_;
  std::optional<DepthCameraSpec> camera_;
  MapSetting home_;
  std::vector<double> levels_m_;  ///< Finest first.
  double door_m_{};               ///< Smaller than all levels; 0: there are no such cells.
  std::vector<double> ranges_m_{};
  Idle idle_;
  Passability passability_;
  Visibility visibility_;
  std::optional<double> last_gap_m_{};  ///< Since narrow places were declared, or the leg began.
  bool seeks_door_{};                   ///< A plan has failed near a narrow place.
  bool has_door_cells_{};               ///< Another one has failed there, in the finest level.
};

}  // namespace flyball
