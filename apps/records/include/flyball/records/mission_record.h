// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Everything that a flown mission leaves.

#include "flyball/kernels/mapper.h"
#include "flyball/records/mission_frame.h"
#include "flyball/records/summary.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/recorder.h"
#include "flyball/sim/world.h"

#include <memory>
#include <vector>

namespace flyball {

struct MissionRecord {
  Summary summary{};
  World world{};
  KnobSettings knobs{};                ///< What the governor could turn, as it stood at the start.
  bool has_goal{true};                 ///< Whether the world's goal was this mission's.
  std::vector<OccupiedCell> map{};     ///< Where a volume was explored: what its map came to.
  Status map_file{Done{}};             ///< Whether the flight's map was written, if it was to be.
  std::vector<MissionFrame> frames{};  ///< What the workload wants to be seen.
  /// Channels and fields: see apps/records/README.md. `state` has 10 rows a second.
  std::shared_ptr<MemoryRecorder> trace{};  ///< Owners: the record and whoever writes it out.
};

}  // namespace flyball
