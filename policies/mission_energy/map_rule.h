// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which cells and which range the map has, by what lies ahead.

#include "flyball/governors/learned_latency.h"
#include "flyball/governors/map_setting.h"
#include "flyball/runtime/board.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include "passability.h"
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Whether the mission makes progress by what its views show, not by the way that it flies.
[[nodiscard]] bool explores(const Observation& seen);

/// What the path ahead asks of the map.
struct MapNeeds {
  double cells_m{};        ///< The largest with which the path ahead is passable.
  double least_range_m{};  ///< 0: any.
  /// Up to here depth noise leaves the gaps ahead open, whatever the cells allow; 0: unknown.
  double clear_range_m{};
  /// Paths through narrow gaps are searched for, which takes long.
  bool needs_top_clock{};
};

/// The largest cells are taken that leave the path ahead open:
/// - They leave the narrowest gap ahead open (`Passability`).
/// - Where narrow gaps are declared and plans keep failing, they are smaller than all others, if
///   the mapper takes any cells: a door loses up to two cells of its width. Nowhere else, because
///   such maps take long.
/// - The ceiling above the vehicle, which larger cells would fill down to it, is not reached.
///
/// The range follows from the cells, because maps of larger ones take less time; that of the
/// smallest ones from how long a map takes on the computer at hand. It ends earlier
/// where the camera's noise is half a cell. A mapper with a lattice keeps all hits, also those far
/// off, so there noise stays below a quarter of the body's width, too. Where wide gaps are seen
/// there may be more noise.
///
/// Nothing allocates after `make`.
class MapRule {
 public:
  /// A policy adds them to its own.
  [[nodiscard]] static std::vector<ParameterSpec> parameters();
  /// @param owner  For messages: `policy "mission_energy"`.
  /// @error `invalid_input` when parameters contradict each other or the knobs.
  static Result<MapRule> make(const std::string& owner,
                              const Parameters& given,
                              const KnobSettings& knobs,
                              const VehicleModel& vehicle);

  /// All that it may take, with the latencies that are expected of them.
  [[nodiscard]] std::vector<LatencyLevel> levels(double fine_s, double coarse_s) const;
  /// The map as the scenario has it, without a clock.
  [[nodiscard]] const MapSetting& home() const { return home_; }

  /// @param cells_m  In force.
  [[nodiscard]] MapNeeds look(const Observation& seen, double cells_m);
  /// What the rule takes, without a clock: legal values of both knobs.
  [[nodiscard]] MapSetting setting(const MapNeeds& needs, const LearnedLatency& latency) const;

  [[nodiscard]] double body_m() const { return body_m_; }
  [[nodiscard]] double finest_m() const { return levels_m_.front(); }
  /// Of cells of .15 m, as far as the knob allows.
  [[nodiscard]] double range_m() const { return range_knob_.nearest(range_m_); }

 private:
  MapRule(const Parameters& given, const KnobSettings& knobs, const VehicleModel& vehicle);
  [[nodiscard]] double coarsest_m(const Observation& seen, bool near, double cells_m);
  [[nodiscard]] bool needs_finest(const Observation& seen, bool near, double cells_m);
  [[nodiscard]] bool needs_door_cells(const Observation& seen, bool near);
  [[nodiscard]] LatencyLevel door_level(const std::vector<LatencyLevel>& others) const;
  [[nodiscard]] Passability passability(const Parameters& given) const;
  [[nodiscard]] double under_ceiling_m(const Observation& seen) const;
  [[nodiscard]] double usual_range_m(double cells_m, const LearnedLatency& latency) const;
  [[nodiscard]] double quick_range_m(double cells_m, const LearnedLatency& latency) const;
  /// Up to here depth noise leaves any gap open that these cells do.
  [[nodiscard]] double most_range_m(double cells_m) const;
  [[nodiscard]] double noise_free_m(double cells_m) const;
  /// The range up to which the camera's noise is at most this. @pre The camera is known.
  [[nodiscard]] double range_with_m(double noise_m) const;
  /// The range up to which noise leaves gaps open like those that were seen; 0: none was.
  [[nodiscard]] double clear_range_m(const Observation& seen, bool near);

  KnobSpec cells_knob_;
  KnobSpec range_knob_;
  bool keeps_hits_;  ///< The mapper does, at its finest level. Any other starts a new map.
  double range_m_;
  double least_range_m_;
  double most_range_m_;
  double small_cells_s_;
  double narrow_m_s_;
  double body_m_;
  double large_m_;  ///< Larger cells may close openings that nobody has seen yet.
  std::optional<DepthCameraSpec> camera_;
  MapSetting home_;
  std::vector<double> levels_m_;  ///< Finest first.
  double door_m_{};               ///< Smaller than all levels; 0: there are no such cells.
  Passability passability_;
  std::optional<double> last_gap_m_{};  ///< Since narrow places were declared, or the leg began.
  bool seeks_door_{};                   ///< A plan has failed near a narrow place.
  bool has_door_cells_{};               ///< Another one has failed there, in the finest level.
};

}  // namespace flyball
