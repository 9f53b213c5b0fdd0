// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A serial line, eight bits without parity.

#include "flyball/vehicles/byte_stream.h"

#include <string>

namespace flyball {

/// @error As `open_byte_stream`.
[[nodiscard]] Result<std::unique_ptr<ByteStream>> open_serial(const std::string& device,
                                                              const std::string& baud);

}  // namespace flyball
