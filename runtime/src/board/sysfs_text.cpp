// SPDX-License-Identifier: BSD-3-Clause
#include "board/sysfs_text.h"

#include "flyball/runtime/text/number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace flyball {
namespace {

constexpr std::string_view blanks{" \t\r\n\0", 5};
constexpr int most_cpus = 8192;  // CONFIG_NR_CPUS of the largest kernels.

}  // namespace

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) {
    return {};
  }
  return std::string{text.substr(begin, text.find_last_not_of(blanks) + 1 - begin)};
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) {
      return words;
    }
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(blanks), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

std::optional<long long> integer_of(std::string_view text) {
  long long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return number;
}

std::vector<int> cpu_list_of(std::string_view text) {
  std::string spaced = trimmed(text);
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::vector<int> cpus;
  for (const std::string& word : words_of(spaced)) {
    const std::size_t dash = word.find('-');
    const auto first = integer_of(std::string_view{word}.substr(0, dash));
    const auto last =
        dash == std::string::npos ? first : integer_of(std::string_view{word}.substr(dash + 1));
    if (!first || !last || *first < 0 || *last < *first || *last >= most_cpus) {
      return {};
    }
    for (long long cpu = *first; cpu <= *last; ++cpu) {
      cpus.push_back(static_cast<int>(cpu));
    }
  }
  std::sort(cpus.begin(), cpus.end());
  cpus.erase(std::unique(cpus.begin(), cpus.end()), cpus.end());
  return cpus;
}

std::optional<int> number_behind(std::string_view prefix, std::string_view name) {
  if (name.substr(0, prefix.size()) != prefix) {
    return std::nullopt;
  }
  const auto number = integer_of(name.substr(prefix.size()));
  if (!number || *number < 0 || *number > 1'000'000) {
    return std::nullopt;
  }
  return static_cast<int>(*number);
}

std::optional<std::string> text_in(const LinuxSystem& system, const std::string& path) {
  const auto content = system.read(path);
  return content ? std::optional{trimmed(*content)} : std::nullopt;
}

std::optional<long long> integer_in(const LinuxSystem& system, const std::string& path) {
  const auto text = text_in(system, path);
  return text ? integer_of(*text) : std::nullopt;
}

std::optional<Hertz> clock_of(std::string_view text) {
  const auto khz = integer_of(text);
  return khz && *khz > 0 ? std::optional{Hertz{1e3 * static_cast<double>(*khz)}} : std::nullopt;
}

std::optional<Hertz> clock_in(const LinuxSystem& system, const std::string& path) {
  const auto text = text_in(system, path);
  return text ? clock_of(*text) : std::nullopt;
}

std::string khz_of(Hertz clock) {
  return std::to_string(std::llround(clock.value() * 1e-3));
}

std::string mhz_of(Hertz clock) {
  return short_number_text(clock.value() * 1e-6) + " MHz";
}

}  // namespace flyball
