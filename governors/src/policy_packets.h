// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What goes between a policy's process and its host, as it lies in memory: both are one program.

#include "flyball/runtime/parameters.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>

namespace flyball {

using Text = std::array<char, 512>;

inline void put(Text& text, std::string_view what) {
  const std::size_t length = std::min(what.size(), text.size() - 1);
  std::memcpy(text.data(), what.data(), length);
  text[length] = '\0';
}

/// One parameter as it travels.
struct ParameterPacket {
  Text name{};
  Text description{};
  double fallback{};
  double min{};
  double max{};
  bool required{};
  bool is_text{};
  Text text_fallback{};
};

inline ParameterPacket packed(const ParameterSpec& spec) {
  ParameterPacket packet;
  put(packet.name, spec.name);
  put(packet.description, spec.description);
  packet.min = spec.min;
  packet.max = spec.max;
  packet.required = spec.required;
  if (const double* number = std::get_if<double>(&spec.fallback)) {
    packet.fallback = *number;
  } else {
    packet.is_text = true;
    put(packet.text_fallback, std::get<std::string>(spec.fallback));
  }
  return packet;
}

inline ParameterSpec unpacked(const ParameterPacket& packet) {
  ParameterSpec spec;
  spec.name = packet.name.data();
  spec.description = packet.description.data();
  spec.min = packet.min;
  spec.max = packet.max;
  spec.required = packet.required;
  spec.fallback = packet.is_text ? ParameterValue{std::string{packet.text_fallback.data()}}
                                 : ParameterValue{packet.fallback};
  return spec;
}

}  // namespace flyball
