// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How coarse a map may be before it closes the way ahead.

#include "flyball/runtime/observation.h"
#include "flyball/runtime/time.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace flyball {

struct PassabilitySettings {
  double body_m{0.71};  ///< Widest part of the vehicle with its tube at a crawl, both sides.
  Duration least{};     ///< A finer level that was needed stays at least this long.
  Duration patience{};  ///< Standing in cruise for so long, there is something that is not seen.
  /// Largest cells where a plan has failed or the vehicle stands; 0: no such limit.
  double retry_m{};
  /// Farther off than this a shut gap is not looked at in finest cells yet; 0: as soon as it shows.
  double near_m{};
};

/// Passability is local: the coarsest level whose cells leave the narrowest gap ahead open. An
/// occupied cell blocks with its full cube, so cells of r show a gap of width w as w - 2 r at the
/// worst; a map of q that shows it as w' promises that r >= q shows at least w' - 2 (r - q). A gap
/// that is shut at q may be open in finer cells, and only they can tell, so they are asked for as
/// soon as it is in sight: before it is reached, and before a plan fails for it. A plan that failed
/// and a vehicle that stands ask for them too; a vehicle that still stands asks to see farther, so
/// it never stands for ever before a gap that it could pass.
///
/// What needed finer cells needs them until the vehicle is past it: finer cells show less far, and
/// a wall that they do not show yet looks like an open way. Where they show that it is not there,
/// they are not needed any longer. Nothing allocates after construction.
class Passability {
 public:
  struct Verdict {
    std::size_t coarsest_level{};
    double look_m{};  ///< The map must reach so far; 0: as far as is worth it.
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
  [[nodiscard]] bool is_far_off(const Observation& seen) const;
  [[nodiscard]] bool is_gone(const Observation& seen);
  void count_way(const Observation& seen);
  [[nodiscard]] Standing standing(const Observation& seen);

  PassabilitySettings settings_;
  std::vector<double> levels_m_;
  std::size_t level_;
  MissionTime needed_at_{};  ///< The last time that no coarser level would have done.
  std::size_t retry_level_;  ///< The coarsest one that `retry_m` allows.
  double gap_on_m_{};        ///< Finest cells are needed for so long a way: until a gap is past,
  double failed_on_m_{};     ///< or where a plan failed.
  std::optional<MissionTime> finest_since_{};  ///< The map has had finest cells.
  std::optional<MissionTime> last_judged_{};
  std::optional<MissionTime> standing_since_{};
};

}  // namespace flyball
