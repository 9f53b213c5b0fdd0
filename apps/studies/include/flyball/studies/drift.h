// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How well a policy keeps its latency bounds ("latency_bounds") while the computer changes: the
/// events, and the count of violations after them.

#include "flyball/runtime/recorder.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"
#include "flyball/scenario/scenario.h"

#include <cstdint>
#include <string>
#include <vector>

namespace flyball {

/// Something that happens to the computer `at_s` after the start, as settings of a scenario.
struct DriftCase {
  std::string name{};
  std::string description{};
  std::vector<std::string> settings{};
  std::string caveat{};  ///< A sentence for the user where it changes more than the event.
};

/// `none`, and one of each: costs that are three times the file's, a co-runner with half the cores
/// and memory, a computer behind a heat sink that gets bad. The last one needs a thermal model: a
/// platform without one is exchanged.
///
/// @param flown  The scenario that the settings are for. Its own events stay.
[[nodiscard]] std::vector<DriftCase> drift_cases(double at_s, const Scenario& flown);

/// The count of a policy's latency bounds at one moment, as recorded.
struct BoundRow {
  MissionTime at{};
  std::uint64_t issued{};  ///< Bounds that were settled until now.
  std::uint64_t late{};    ///< How many of them were violated.
};

/// All rows of channel `latency_bound` in a record, in order.
using DriftRecord = std::vector<BoundRow>;

[[nodiscard]] DriftRecord drift_record(const MemoryRecorder& trace);
/// The same for a flight on disk.
///
/// @error `not_found`, `invalid_input` when there is no such record or it is broken.
[[nodiscard]] Result<DriftRecord> read_drift_record(const std::string& run_folder);

/// Latency bounds number `first` to `last` after an event, counted from 1.
struct DriftCount {
  std::uint64_t decisions{};  ///< Fewer than `last - first + 1` when the mission ended before.
  std::uint64_t late{};
  [[nodiscard]] double late_share() const {
    return decisions == 0 ? 0.0 : static_cast<double>(late) / static_cast<double>(decisions);
  }
};
[[nodiscard]] DriftCount count_bounds(const DriftRecord& record,
                                      MissionTime event,
                                      std::uint64_t first,
                                      std::uint64_t last);

}  // namespace flyball
