// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Numbers as text, with a point in every locale. `std::to_string` writes `260.000000`, and
/// `printf` and it write a comma where the program around Flyball has chosen such a locale.

#include <string>

namespace flyball {

/// The shortest text that reads back as the same number: `0.1`, `1e-04`, `nan`.
[[nodiscard]] std::string number_text(double value);

/// The number with at most so many significant digits, from 1 to 17: six as people read it in
/// messages and tables; with 17 each number reads back as the same.
[[nodiscard]] std::string short_number_text(double value, int digits = 6);

}  // namespace flyball
