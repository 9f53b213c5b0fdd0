// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A summary of somebody else, or a damaged one: what is wrong with it.

#include "flyball/records/summary.h"
#include "flyball/runtime/result.h"

namespace flyball {

/// As `from_json`.
/// @error `invalid_input` when the text is not a summary, with the member that is wrong.
[[nodiscard]] Result<Summary> read_summary(const std::string& text);

}  // namespace flyball
