// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/text/printable.h"

#include <cstddef>
#include <cstdint>

namespace flyball {
namespace {

struct Character {
  std::uint32_t code{};
  std::size_t bytes{};  ///< 0: this is no UTF-8.
};

std::uint8_t byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

/// RFC 3629.
Character first_of(std::string_view text) {
  const std::uint8_t lead = byte_at(text, 0);
  if (lead < 0x80U) {
    return {lead, 1};
  }
  const std::size_t bytes = lead >= 0xf0U ? 4 : lead >= 0xe0U ? 3 : lead >= 0xc0U ? 2 : 0;
  if (bytes == 0 || lead > 0xf4U) {
    return {};
  }
  std::uint32_t code = lead & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte_at(text, i) & 0xc0U) != 0x80U) {
      return {};
    }
    code = (code << 6U) | (byte_at(text, i) & 0x3fU);
  }
  constexpr std::uint32_t least_of_bytes[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xd800U && code <= 0xdfffU;
  return code < least_of_bytes[bytes] || code > 0x10ffffU || is_surrogate ? Character{}
                                                                          : Character{code, bytes};
}

bool steers(std::uint32_t code) {
  const bool is_control = code < 0x20U || (code >= 0x7fU && code < 0xa0U);
  const bool breaks_line = code == 0x2028U || code == 0x2029U;
  const bool turns = (code >= 0x202aU && code <= 0x202eU) || (code >= 0x2066U && code <= 0x2069U) ||
                     code == 0x200eU || code == 0x200fU;
  return is_control || breaks_line || turns;
}

void append_escaped(std::string* out, std::uint8_t byte) {
  constexpr const char* digits = "0123456789abcdef";
  *out += "\\x";
  *out += digits[byte >> 4U];
  *out += digits[byte & 0xfU];
}

}  // namespace

std::string printable(std::string_view text, std::string_view kept) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto [code, bytes] = first_of(text);
    const bool is_kept = kept.find(text.front()) != std::string_view::npos;
    const std::size_t taken = bytes == 0 ? 1 : bytes;
    if (bytes > 0 && (is_kept || !steers(code))) {
      out.append(text.substr(0, taken));
    } else {
      for (std::size_t i = 0; i < taken; ++i) {
        append_escaped(&out, byte_at(text, i));
      }
    }
    text.remove_prefix(taken);
  }
  return out;
}

}  // namespace flyball
