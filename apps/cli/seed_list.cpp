// SPDX-License-Identifier: BSD-3-Clause

#include "seed_list.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace flyball {
namespace {

constexpr std::uint64_t most_seeds = 100000;
constexpr std::uint64_t largest_seed = INT64_MAX;  // TOML's integers end there.

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole =
      failed == std::errc{} && end == text.data() + text.size() && value <= largest_seed;
  return whole ? std::optional{value} : std::nullopt;
}

Error wrong(const std::string& option, const std::string& text, const std::string& why) {
  return {ErrorCode::invalid_input,
          option + " " + text + " " + why + "; give for example 1..10 or 3 or 1,4,9"};
}

}  // namespace

Result<std::vector<std::uint64_t>> read_seeds(const std::string& text, const std::string& option) {
  std::vector<std::uint64_t> seeds;
  if (const std::size_t dots = text.find(".."); dots != std::string::npos) {
    const auto first = number(std::string_view{text}.substr(0, dots));
    const auto last = number(std::string_view{text}.substr(dots + 2));
    if (!first || !last) {
      return wrong(option, text, "is no range of whole numbers up to 2^63 - 1");
    }
    if (*first > *last || *last - *first >= most_seeds) {
      return wrong(option, text,
                   *first > *last ? "ends before it begins" : "is more than 100000 seeds");
    }
    for (std::uint64_t seed = *first; seed <= *last; ++seed) {
      seeds.push_back(seed);
    }
    return seeds;
  }
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto seed = number(std::string_view{text}.substr(at, comma - at));
    if (!seed) {
      return wrong(option, text, "is no list of whole numbers up to 2^63 - 1");
    }
    seeds.push_back(*seed);
    at = comma + 1;
  }
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  return seeds;
}

}  // namespace flyball
