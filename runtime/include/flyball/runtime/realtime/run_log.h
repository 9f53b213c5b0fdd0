// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What happened in a real-time run, so that it can be run again.

#include "flyball/runtime/executor.h"

#include <cstdint>
#include <vector>

namespace flyball {

/// One step of the run.
struct RunEvent {
  enum class Kind : std::uint8_t {
    publish,  ///< From outside the graph.
    start,    ///< A job takes its messages and computes.
    end,      ///< Its publications appear, unless it was killed.
    forgo,    ///< A job was killed before it started.
  };
  Kind kind{};
  MissionTime at{};
  int index{};         ///< Topic of `publish`, node of the others.
  Message message{};   ///< Of `publish`.
  JobRecord record{};  ///< Of the others; `reads` and what follows from the end, there only.
};

/// All steps in the order in which the executor did them; it keeps every message that came from
/// outside, which is a second of camera frames in some 30 MB: for tests and short runs.
struct RunLog {
  std::vector<RunEvent> events{};
};

}  // namespace flyball
