// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How often a page or a picture says something.

#include <cstddef>
#include <string>

namespace flyball::kit {

/// @pre `part` is not empty.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

}  // namespace flyball::kit
