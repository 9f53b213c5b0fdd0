// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Datagrams on this computer.

#include "flyball/vehicles/byte_stream.h"

#include <string>

namespace flyball {

/// @error As `open_byte_stream`.
[[nodiscard]] Result<std::unique_ptr<ByteStream>> open_udp(const std::string& host,
                                                           const std::string& port);

}  // namespace flyball
