// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/text/number_text.h"

#include <array>
#include <charconv>

namespace flyball {

std::string number_text(double value) {
  std::array<char, 32> text{};  // The longest has 24 characters.
  return {text.begin(), std::to_chars(text.begin(), text.end(), value).ptr};
}

std::string short_number_text(double value, int digits) {
  std::array<char, 32> text{};
  return {text.begin(),
          std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits).ptr};
}

}  // namespace flyball
