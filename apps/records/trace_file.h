// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The record as text: one JSON object a line.

#include "flyball/runtime/recorder.h"
#include "flyball/scenario/scenario.h"

#include <string>

namespace flyball {

/// The first line describes the mission. Every other line is a row with `t_s`, `channel` and its
/// fields. Numbers have 17 digits, so that they read back to the same bits; a number that is not
/// finite is null.
[[nodiscard]] std::string trace_lines(const Scenario& scenario, const MemoryRecorder& trace);

}  // namespace flyball
