// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How coarse a map may be before it closes the gaps ahead.

#include "flyball/runtime/observation.h"
#include "flyball/runtime/time.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace flyball {

/// What cells of this size leave at the worst of a gap that a map of `map_resolution_m` shows as
/// `gap_m`; finer cells than the map's leave as much.
[[nodiscard]] double left_of_gap_m(double gap_m, double cells_m, double map_resolution_m);

struct PassabilitySettings {
  double body_m{0.71};  ///< Width of the vehicle with its tube at a crawl, both sides together.
  Duration least{};     ///< A finer level that was needed is kept at least this long.
  Duration patience{};  ///< A vehicle that stands this long in cruise lacks a view of something.
  /// Largest cells after a plan has failed or while the vehicle stands.
  double retry_m{0.355};
  /// A closed gap gets the finest cells once it is nearer than this, and before it the next ones.
  double near_m{8.0};
};

/// Finds the coarsest level whose cells leave the narrowest gap ahead open. An occupied cell blocks
/// with its full cube, so cells of size r show a gap of width w as w - 2 r at the worst. If a map
/// of cells of q shows it as w', cells of r >= q show at least w' - 2 (r - q).
///
/// A gap that is closed in cells of q may be open in finer ones, and only they can tell. So finer
/// cells are asked for as soon as the gap shows, before the vehicle reaches it and before a plan
/// fails. They are also asked for when a plan has failed and when the vehicle stands. If it still
/// stands then, a longer range is asked for, so that it never stands for ever before a gap that it
/// could pass.
///
/// A gap that needed finer cells keeps them until the vehicle is behind it. The reason is that the
/// range of finer cells is shorter, and a wall that they do not show yet looks like open space. The
/// finer cells are given up earlier if they show that there is no such gap. Nothing allocates after
/// construction.
class Passability {
 public:
  struct Verdict {
    std::size_t coarsest_level{};
    double look_m{};  ///< The range that the map must have; 0: the search chooses it.
  };

  /// @param levels_m  Cell sizes, finest first. @pre Not empty.
  Passability(const PassabilitySettings& settings, std::vector<double> levels_m);

  [[nodiscard]] Verdict judge(const Observation& seen);

 private:
  enum class Standing { no, stuck, for_good };
  [[nodiscard]] double least_m(std::size_t level) const;
  [[nodiscard]] std::size_t open_level(const Observation& seen) const;
  [[nodiscard]] std::size_t clear_level(const Observation& seen, std::size_t open) const;
  void need_until_past(const Observation& seen, Standing standing);
  [[nodiscard]] std::size_t needed_level(const Observation& seen, Standing standing) const;
  [[nodiscard]] bool is_gone(const Observation& seen);
  void count_path(const Observation& seen);
  [[nodiscard]] Standing standing(const Observation& seen);

  PassabilitySettings settings_;
  std::vector<double> levels_m_;
  std::size_t level_;
  MissionTime needed_at_{};  ///< The last time that a coarser level would have closed a gap.
  std::size_t retry_level_;  ///< The coarsest level that `retry_m` allows.
  double gap_on_m_{};        ///< Distance for which a gap still needs the finest cells, ...
  double failed_on_m_{};     ///< ... and for which a failed plan does.
  std::optional<MissionTime> finest_since_{};  ///< Since when the map has the finest cells.
  std::optional<MissionTime> last_judged_{};
  std::optional<MissionTime> standing_since_{};
};

}  // namespace flyball
