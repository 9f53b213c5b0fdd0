// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/text_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>

namespace flyball {

std::string rounded(double value, int digits) {
  std::array<char, 400> text{};  // The largest double has 309 digits before the point.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): streams need four calls for the same
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::size_t letters_in(const std::string& text) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins));
}

std::string aligned(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      widths[i] = std::max(widths[i], letters_in(line[i]));
    }
  }
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      text += line[i] + std::string(widths[i] - letters_in(line[i]) + 2, ' ');
    }
    text += (line.empty() ? "" : line.back()) + "\n";
  }
  return text;
}

std::string html_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string html_table(const std::string& rows) {
  return "<div class=\"table\"><table>\n" + rows + "\n</table></div>\n";
}

}  // namespace flyball
