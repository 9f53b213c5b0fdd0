// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the governor did in a flight, as JSON for the report's plots: the values of each knob over
/// time, and when its fallback was in force.

#include "flyball/records/mission_record.h"

#include <nlohmann/json.hpp>

namespace flyball {

/// One object for each knob, in the order of their declaration: `name`, `unit`, `description`, the
/// legal range as `min` and `max` or the values as `legal`, what they stand for as `labels`, and
/// the steps as times `t` and values `v`. `changes` counts the steps after the first.
///
/// Every change is a step until there are thousands of them. Then the flight is divided into
/// intervals narrower than a pixel of the plot, and each one keeps its first, lowest, highest and
/// last value, so that the plot looks the same.
[[nodiscard]] nlohmann::ordered_json knobs_json(const MissionRecord& record);

/// Each step of the fallback as [time, name, why]; the name `none` ends it.
[[nodiscard]] nlohmann::ordered_json fallback_json(const MemoryRecorder& trace);

}  // namespace flyball
