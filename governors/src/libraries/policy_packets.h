// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What goes between a policy's process and its host, as it lies in memory: both are one program.
/// The process may have been taken over by what it loaded, so nothing that comes from it is used
/// before a `fault_of` has looked at it: no enumeration, no bool, no text.

#include "flyball/runtime/decision.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>

namespace flyball {

using Text = std::array<char, 512>;

inline void put(Text& text, std::string_view what) {
  const std::size_t length = std::min(what.size(), text.size() - 1);
  std::memcpy(text.data(), what.data(), length);
  text[length] = '\0';
}

/// The first answer of a process: how many parameters follow, or why not.
struct OpeningPacket {
  std::uint32_t ok{};
  std::uint32_t is_confined{};
  std::uint32_t code{static_cast<std::uint32_t>(ErrorCode::failed)};
  std::uint32_t parameters{};
  std::int64_t period_ns{-1};
  Text why{};
};

/// One parameter as it travels.
struct ParameterPacket {
  std::uint32_t required{};
  std::uint32_t is_text{};
  double fallback{};
  double min{};
  double max{};
  Text name{};
  Text description{};
  Text text_fallback{};
};

struct QuestionPacket {
  std::uint64_t number{};
  Observation seen{};
};

/// A decision as it travels: knobs by their place.
struct AnswerPacket {
  struct Wish {
    std::uint64_t knob{};  ///< Beyond the last one: it does not exist.
    double value{};
  };
  std::uint64_t number{};  ///< Of the question.
  std::uint32_t reason{};
  std::uint32_t overflowed{};
  std::uint64_t size{};
  std::array<Wish, Decision::capacity> wishes{};
  Text trouble{};
  Text remark{};
};

constexpr std::uint32_t most_parameters = 100;

/// Whether all of them end.
inline bool end(std::initializer_list<const Text*> texts) {
  return std::all_of(texts.begin(), texts.end(), [](const Text* text) {
    return std::find(text->begin(), text->end(), '\0') != text->end();
  });
}

/// What is wrong with a packet, as the end of a sentence; nullptr: nothing.
inline const char* fault_of(const OpeningPacket& packet) {
  constexpr auto last = static_cast<std::uint32_t>(ErrorCode::unavailable);
  return !end({&packet.why})                       ? "sent a text that does not end"
         : packet.ok > 1 || packet.is_confined > 1 ? "sent a yes or no that is neither"
         : packet.code > last                      ? "sent an error that there is not"
         : packet.parameters > most_parameters     ? "declares more than 100 parameters"
                                                   : nullptr;
}

inline const char* fault_of(const ParameterPacket& packet) {
  return !end({&packet.name, &packet.description, &packet.text_fallback})
             ? "sent a text that does not end"
         : packet.required > 1 || packet.is_text > 1 ? "sent a yes or no that is neither"
                                                     : nullptr;
}

/// @param number  Of the question.
inline const char* fault_of(const AnswerPacket& packet, std::uint64_t number) {
  return !end({&packet.trouble, &packet.remark}) ? "sent a text that does not end"
         : packet.number != number               ? "answered another question than it was asked"
         : packet.overflowed > 1                 ? "sent a yes or no that is neither"
         : packet.size > Decision::capacity      ? "sent more wishes than a decision has"
         : packet.reason > static_cast<std::uint32_t>(Reason::fallback)
             ? "sent a reason that there is not"
             : nullptr;
}

inline ParameterPacket packed(const ParameterSpec& spec) {
  ParameterPacket packet;
  put(packet.name, spec.name);
  put(packet.description, spec.description);
  packet.min = spec.min;
  packet.max = spec.max;
  packet.required = spec.required ? 1 : 0;
  if (const double* number = std::get_if<double>(&spec.fallback)) {
    packet.fallback = *number;
  } else {
    packet.is_text = 1;
    put(packet.text_fallback, std::get<std::string>(spec.fallback));
  }
  return packet;
}

/// @pre It has no fault.
inline ParameterSpec unpacked(const ParameterPacket& packet) {
  ParameterSpec spec;
  spec.name = packet.name.data();
  spec.description = packet.description.data();
  spec.min = packet.min;
  spec.max = packet.max;
  spec.required = packet.required != 0;
  spec.fallback = packet.is_text != 0 ? ParameterValue{std::string{packet.text_fallback.data()}}
                                      : ParameterValue{packet.fallback};
  return spec;
}

}  // namespace flyball
