// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The text files of recordings: lines of numbers and names.

#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

struct TextLine {
  int number{};
  std::vector<std::string> words{};
};

/// The lines that are neither empty nor comments (#), cut at blanks, tabs and commas.
/// @error `not_found` when the file cannot be read.
[[nodiscard]] Result<std::vector<TextLine>> read_lines(const std::string& file);

/// Decimal seconds to the nanosecond (a double holds those of today to .2 us); nanoseconds when the
/// text has no point and more than 12 digits, as EuRoC has them. Empty when it is no time.
[[nodiscard]] std::optional<MissionTime> to_time(const std::string& text);

/// Empty when the text is no finite number.
[[nodiscard]] std::optional<double> to_number(const std::string& text);

/// The words from `first` on as numbers, `count` of them.
/// @error `invalid_input`: names the file, the line and the word.
[[nodiscard]] Result<std::vector<double>> numbers_of(const std::string& file,
                                                     const TextLine& line,
                                                     std::size_t first,
                                                     std::size_t count);

/// Whether a line's time is no earlier than the line's before: what runs back in time would be
/// dropped without a word.
/// @error `invalid_input`: names the file, the line and the time.
[[nodiscard]] Status check_order(const std::string& file,
                                 const TextLine& line,
                                 MissionTime last,
                                 MissionTime now);

/// "FILE:LINE: what".
[[nodiscard]] Error wrong(const std::string& file, const TextLine& line, const std::string& what);

}  // namespace flyball
