// SPDX-License-Identifier: BSD-3-Clause
// tested-in: recording

#include "recordings/recording_text.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace flyball {
namespace {

bool is_gap(char c) {
  return c == ',' || std::isspace(static_cast<unsigned char>(c)) != 0;
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : line) {
    if (!is_gap(c)) {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::move(word));
      word.clear();
    }
  }
  if (!word.empty()) {
    words.push_back(std::move(word));
  }
  return words;
}

/// Of digits only; at most 18, so that it fits.
std::optional<std::int64_t> digits(const std::string& text) {
  std::int64_t value = 0;
  if (text.empty() || text.size() > 18) {
    return std::nullopt;
  }
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = failed == std::errc{} && end == text.data() + text.size() && text[0] != '-';
  return whole ? std::optional{value} : std::nullopt;
}

}  // namespace

Error wrong(const std::string& file, const TextLine& line, const std::string& what) {
  return {ErrorCode::invalid_input, file + ":" + std::to_string(line.number) + ": " + what};
}

Status check_order(const std::string& file,
                   const TextLine& line,
                   MissionTime last,
                   MissionTime now) {
  if (now >= last) {
    return Done{};
  }
  return wrong(file, line,
               "the time " + line.words.front() +
                   " is earlier than that of the line before; sort the lines by time");
}

Result<std::vector<TextLine>> read_lines(const std::string& file) {
  std::error_code failed;
  std::ifstream in{file};
  if (!in || !std::filesystem::is_regular_file(file, failed)) {
    return Error{ErrorCode::not_found, "cannot read \"" + file + "\""};
  }
  std::vector<TextLine> lines;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    TextLine line{number, words_of(text)};
    if (!line.words.empty() && line.words.front().front() != '#') {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

std::optional<MissionTime> to_time(const std::string& text) {
  constexpr std::size_t most_digits_of_seconds = 12;
  constexpr std::int64_t second_ns = 1'000'000'000;
  const std::size_t point = text.find('.');
  const std::string front = text.substr(0, point);
  if (point == std::string::npos && front.size() > most_digits_of_seconds) {
    std::int64_t ns = 0;
    const auto [end, failed] = std::from_chars(front.data(), front.data() + front.size(), ns);
    const bool whole = failed == std::errc{} && end == front.data() + front.size();
    return whole ? std::optional{MissionTime{Duration{ns}}} : std::nullopt;
  }
  const auto seconds = digits(front);
  if (!seconds || *seconds > 9'000'000'000) {
    return std::nullopt;
  }
  std::string behind = point == std::string::npos ? "" : text.substr(point + 1);
  behind.resize(9, '0');
  const auto ns = digits(behind);
  return ns ? std::optional{MissionTime{Duration{*seconds * second_ns + *ns}}} : std::nullopt;
}

std::optional<double> to_number(const std::string& text) {
  double value = 0.0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = failed == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional{value} : std::nullopt;
}

Result<std::vector<double>> numbers_of(const std::string& file,
                                       const TextLine& line,
                                       std::size_t first,
                                       std::size_t count) {
  if (line.words.size() < first + count) {
    return wrong(file, line,
                 std::to_string(line.words.size()) + " columns, at least " +
                     std::to_string(first + count) + " are needed");
  }
  std::vector<double> numbers;
  for (std::size_t i = first; i < first + count; ++i) {
    const auto value = to_number(line.words[i]);
    if (!value) {
      return wrong(file, line, "\"" + line.words[i] + "\" is no number");
    }
    numbers.push_back(*value);
  }
  return numbers;
}

}  // namespace flyball
