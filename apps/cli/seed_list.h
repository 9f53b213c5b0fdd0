// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flyball/runtime/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace flyball {

/// Reads `1..10`, `3` or `1,4,9`; at most 100 000 seeds, each at most 2^63 - 1.
/// @param option  That gives them, for the message.
/// @error `invalid_input` for anything else.
[[nodiscard]] Result<std::vector<std::uint64_t>> read_seeds(const std::string& text,
                                                            const std::string& option = "--seeds");

}  // namespace flyball
