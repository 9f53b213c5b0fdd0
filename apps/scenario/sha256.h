// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// SHA-256 (FIPS 180-4).

#include <string>
#include <string_view>

namespace flyball {

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256_of(std::string_view content);

}  // namespace flyball
