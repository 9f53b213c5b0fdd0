// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace flyball {

/// Text that shows as itself in a page, in an element or an attribute.
[[nodiscard]] inline std::string html_text(const std::string& text) {
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

}  // namespace flyball
