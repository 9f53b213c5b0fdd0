// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Figures as people read them: on a terminal and in a page.

#include <cstddef>
#include <string>
#include <vector>

namespace flyball {

/// With so many digits after the point.
[[nodiscard]] std::string rounded(double value, int digits);

/// Of UTF-8; each is taken to be as wide as any other.
[[nodiscard]] std::size_t letters_in(const std::string& text);

/// Columns of equal width, two blanks apart; the last one is as long as it is.
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& lines);

/// Text that shows as itself in a page, in an element or an attribute.
[[nodiscard]] std::string html_text(const std::string& text);

/// A table of these rows (`<tr>...`) that scrolls by itself where its card is too narrow for it.
[[nodiscard]] std::string html_table(const std::string& rows);

}  // namespace flyball
