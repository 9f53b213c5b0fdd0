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
};

/// Passability is local: the coarsest level whose cells leave the narrowest gap ahead open. An
/// occupied cell blocks with its full cube, so cells of r show a gap of width w as w - 2 r at the
/// worst; a map of q that shows it as w' promises that r >= q shows at least w' - 2 (r - q). A gap
/// that is shut at q may be open in finer cells, and only they can tell, so they are asked for as
/// soon as it is in sight: before it is reached, and before a plan fails for it. A plan that failed
/// and a vehicle that stands ask for them too; a vehicle that still stands asks to see farther, so
/// it never stands for ever before a gap that it could pass. Nothing allocates after construction.
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
  [[nodiscard]] std::size_t open_level(const Observation& seen) const;
  [[nodiscard]] bool is_clear_of_obstacles(const Observation& seen, std::size_t level) const;
  [[nodiscard]] Duration standing(const Observation& seen);

  PassabilitySettings settings_;
  std::vector<double> levels_m_;
  std::size_t level_;
  MissionTime needed_at_{};  ///< The last time that no coarser level would have done.
  std::optional<MissionTime> standing_since_{};
};

}  // namespace flyball
