// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where nodes run, as the knobs say.

#include "flyball/runtime/board.h"
#include "flyball/runtime/knob.h"

#include <map>
#include <string>

namespace flyball {

/// Each knob `offload.<node>` says whether the next jobs of this node run on board (0) or on the
/// edge computer (1).
class NodePlaces {
 public:
  /// Tells the board what has changed since the last call.
  void apply(const KnobSettings& knobs, Board& board);

 private:
  std::map<std::string, bool> on_edge_{};  ///< By node, as the board was told.
};

}  // namespace flyball
