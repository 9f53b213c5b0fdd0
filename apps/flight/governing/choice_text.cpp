// SPDX-License-Identifier: BSD-3-Clause
// tested-in: replay

#include "flyball/flight/governing/choice_text.h"

#include "flyball/runtime/text/number_text.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <string_view>
#include <system_error>

namespace flyball {
namespace {

constexpr std::string_view fallback_mark = "fallback ";

std::string exact(double value) {
  return short_number_text(value, 17);
}

/// The number that the rest of a word is, if it is one.
std::optional<double> number_in(const std::string& word, std::size_t begin) {
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [at, failed] = std::from_chars(word.data() + begin, end, value);
  return failed == std::errc{} && at == end ? std::optional{value} : std::nullopt;
}

bool equal(const Decision& a, const Decision& b) {
  return a.reason == b.reason &&
         std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
           return x.knob == y.knob && have_same_bits(x.value, y.value);
         });
}

}  // namespace

bool have_same_bits(double a, double b) {
  std::uint64_t bits_a = 0;
  std::uint64_t bits_b = 0;
  std::memcpy(&bits_a, &a, sizeof a);
  std::memcpy(&bits_b, &b, sizeof b);
  return bits_a == bits_b;
}

std::string settings_text(const Decision& decision) {
  std::string text;
  for (const auto& [knob, value] : decision) {
    text += (text.empty() ? "" : " ") + std::string{knob} + "=" + exact(value);
  }
  return text.empty() ? "nothing" : text;
}

std::string choice_text(const PolicyGovernor& governor, const Decision& answer) {
  std::string text = std::string{to_string(answer.reason)} + ": " + settings_text(answer);
  const std::string wished = settings_text(governor.wished());
  if (wished != settings_text(answer)) {
    text += "; wished " + wished;
  }
  if (governor.fallback() != Fallback::none) {
    text += "; fallback " + std::string{to_string(governor.fallback())};
  }
  return text;
}

std::string fallback_text(Fallback step, const std::string& why) {
  return std::string{fallback_mark}.append(to_string(step)) + (why.empty() ? "" : ": " + why);
}

std::optional<FallbackStep> fallback_in(const std::string& event) {
  if (event.rfind(fallback_mark, 0) != 0) {
    return std::nullopt;
  }
  const std::string step = event.substr(fallback_mark.size());
  const std::size_t colon = step.find(": ");
  return colon == std::string::npos ? FallbackStep{step, ""}
                                    : FallbackStep{step.substr(0, colon), step.substr(colon + 2)};
}

std::optional<std::map<std::string, double>> settings_of(const std::string& choice) {
  const std::size_t colon = choice.find(": ");
  if (colon == std::string::npos) {
    return std::nullopt;
  }
  std::map<std::string, double> settings;
  std::istringstream words{choice.substr(colon + 2, choice.find(';', colon) - (colon + 2))};
  std::size_t count = 0;
  for (std::string word; words >> word; ++count) {
    const std::size_t equals = word.find('=');
    const auto value = equals == std::string::npos ? std::nullopt : number_in(word, equals + 1);
    if (value) {
      settings[word.substr(0, equals)] = *value;
    } else if (word != "nothing") {
      return std::nullopt;
    }
  }
  return count == 0 ? std::nullopt : std::optional{settings};
}

bool ChoiceMemory::is_new(const PolicyGovernor& governor, const Decision& answer) {
  const bool same = has_one_ && governor.fallback() == fallback_ && equal(answer, answer_) &&
                    equal(governor.wished(), wished_);
  if (!same) {
    wished_ = governor.wished();
    answer_ = answer;
    fallback_ = governor.fallback();
    has_one_ = true;
  }
  return !same;
}

}  // namespace flyball
