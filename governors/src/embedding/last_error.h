// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The sentence that a C caller may read after a call that did nothing.

#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>

namespace flyball {

/// Keeps one sentence, and allocates nothing. Names in it come from callers: what could steer a
/// terminal or begin another line becomes a space.
class LastError {
 public:
  /// @return  The code.
  [[gnu::format(printf, 3, 4)]] std::int32_t set(std::int32_t code,
                                                 const char* format,
                                                 ...) noexcept {
    std::va_list values;
    va_start(values, format);
    std::vsnprintf(text_.data(), text_.size(), format, values);
    va_end(values);
    for (char& letter : text_) {
      const auto byte = static_cast<unsigned char>(letter);
      if ((byte < 0x20 && byte != 0) || byte == 0x7f) {
        letter = ' ';
      }
    }
    return code;
  }
  [[nodiscard]] const char* text() const noexcept { return text_.data(); }

 private:
  std::array<char, 1024> text_{};
};

}  // namespace flyball
