// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Writes protobuf messages: https://protobuf.dev/programming-guides/encoding

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace flyball {

/// One message. Fields may come in any order; a field that comes again is one more of a list.
class Protobuf {
 public:
  /// Types `int32`, `int64` (where they are not negative), `uint32`, `uint64`, `bool` and enums.
  Protobuf& number(int field, std::uint64_t value) {
    key(field, Kind::varint);
    varint(value);
    return *this;
  }
  /// Type `double`.
  Protobuf& real(int field, double value) {
    key(field, Kind::bytes_8);
    std::uint64_t bits{};
    std::memcpy(&bits, &value, sizeof bits);
    fixed(bits, sizeof bits);
    return *this;
  }
  /// Type `fixed32`.
  Protobuf& fixed32(int field, std::uint32_t value) {
    key(field, Kind::bytes_4);
    fixed(value, sizeof value);
    return *this;
  }
  /// Types `string` and `bytes`.
  Protobuf& text(int field, std::string_view value) {
    key(field, Kind::sized);
    varint(value.size());
    bytes_.append(value);
    return *this;
  }
  Protobuf& message(int field, const Protobuf& value) { return text(field, value.bytes_); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  enum class Kind : std::uint8_t { varint = 0, bytes_8 = 1, sized = 2, bytes_4 = 5 };
  void key(int field, Kind kind) {
    varint((static_cast<std::uint64_t>(field) << 3U) | static_cast<std::uint64_t>(kind));
  }
  void varint(std::uint64_t value) {
    for (; value >= 0x80U; value >>= 7U) {
      bytes_.push_back(static_cast<char>((value & 0x7fU) | 0x80U));
    }
    bytes_.push_back(static_cast<char>(value));
  }
  void fixed(std::uint64_t value, unsigned bytes) {
    for (unsigned byte = 0; byte < bytes; ++byte) {
      bytes_.push_back(static_cast<char>((value >> (8 * byte)) & 0xffU));
    }
  }
  std::string bytes_{};
};

}  // namespace flyball
