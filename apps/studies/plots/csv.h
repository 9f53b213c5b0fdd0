// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Rows of a CSV file (RFC 4180).

#include <string>
#include <vector>

namespace flyball {

/// A field stands in quotes where it holds a comma, a quote or a new line.
[[nodiscard]] std::string csv_row(const std::vector<std::string>& fields);
/// The shortest text that reads back to the same number.
[[nodiscard]] std::string csv_number(double value);

}  // namespace flyball
