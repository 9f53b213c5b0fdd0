// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A question about a mission that can only be answered with the true world.

#include "flyball/flight/mission_end.h"
#include "flyball/records/mission_frame.h"
#include "flyball/runtime/time.h"

#include <map>
#include <string>
#include <vector>

namespace flyball {

/// Judges listen to what the vehicle publishes and are never heard on board.
class Judge {
 public:
  Judge() = default;
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;
  virtual ~Judge() = default;

  /// Called once, before the mission's time begins: for what takes long to compute.
  virtual void prepare() {}
  /// Called once a second of mission time.
  virtual void look(MissionTime /*now*/) {}
  /// Why the judge rejects a success that the vehicle claims; `none` when it accepts it.
  [[nodiscard]] virtual MissionFailure objection() const { return MissionFailure::none; }
  /// The unit of a figure is its name's ending.
  [[nodiscard]] virtual std::map<std::string, double> figures() const { return {}; }
  /// Pictures for the report. There should be few, because each is kept in full.
  [[nodiscard]] virtual std::vector<MissionFrame> frames() const { return {}; }
};

}  // namespace flyball
