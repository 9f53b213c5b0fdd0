// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/claim.h"

#include "flyball/records/text_table.h"

#include "studies/plots/heat_map.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

constexpr double tolerance = 0.25;

bool is_near(const Claim& claim, double ours) {
  const double paper = claim.paper->value;
  const double distance = std::max(tolerance * std::abs(paper), claim.slack);
  switch (claim.match) {
    case PaperMatch::at_least:
      return ours >= paper - claim.slack;
    case PaperMatch::at_most:
      return ours <= paper + claim.slack;
    case PaperMatch::value:
      break;
  }
  return std::abs(ours - paper) <= distance;
}

bool has_trend(const Claim& claim) {
  if (!claim.neutral) {
    return false;
  }
  const double neutral = *claim.neutral;
  const MedianInterval& ours = *claim.ours.value;
  return claim.paper->value > neutral ? ours.lo > neutral
                                      : claim.paper->value < neutral && ours.hi < neutral;
}

std::string sentence_of(const Claim& claim, const Cause& cause) {
  std::string text = cause.changed + ": " + measured_text(cause.ours, claim.unit);
  const auto share = share_of_gap(claim, cause);
  if (share && verdict_of(claim) != Verdict::reproduced) {  // Else there is hardly a gap.
    const double percent = 100.0 * std::abs(*share);
    text += *share < 0.0 ? ", which widens the gap by " + rounded(percent, 0) + " %"
                         : ", which closes " + rounded(percent, 0) + " % of the gap";
  }
  return text + ".";
}

}  // namespace

PaperValue paper_change(double percent, const std::string& where) {
  return {1.0 + percent / 100.0, where};
}

Measured computed(double value) {
  return {MedianInterval{value, value, value}, 0};
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::same_trend:
      return "same trend";
    case Verdict::not_reproduced:
      return "not reproduced";
    case Verdict::not_measured:
      return "not measured";
    case Verdict::ours:
      break;
  }
  return "ours";
}

Verdict verdict_of(const Claim& claim) {
  if (!claim.ours.value) {
    return Verdict::not_measured;
  }
  if (!claim.paper) {
    return Verdict::ours;
  }
  if (is_near(claim, claim.ours.value->median)) {
    return Verdict::reproduced;
  }
  return has_trend(claim) ? Verdict::same_trend : Verdict::not_reproduced;
}

std::optional<double> share_of_gap(const Claim& claim, const Cause& cause) {
  if (!claim.paper || !claim.ours.value || !cause.ours.value) {
    return std::nullopt;
  }
  const double paper = claim.paper->value;
  const double ours = claim.ours.value->median;
  const double changed = cause.ours.value->median;
  if (!(paper > 0.0) || !(ours > 0.0) || !(changed > 0.0) || paper == ours) {
    return std::nullopt;
  }
  return std::log(changed / ours) / std::log(paper / ours);
}

std::string cause_text(const Claim& claim) {
  std::vector<std::pair<double, std::string>> sentences;
  for (const Cause& cause : claim.causes) {
    constexpr double unknown = -1e9;  // Behind all whose share is known.
    sentences.emplace_back(share_of_gap(claim, cause).value_or(unknown), sentence_of(claim, cause));
  }
  std::stable_sort(sentences.begin(), sentences.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (const auto& [share, sentence] : sentences) {
    text += (text.empty() ? "" : " ") + sentence;
  }
  return text;
}

std::string measured_text(const Measured& measured, const std::string& unit) {
  if (!measured.value) {
    return "-";
  }
  const MedianInterval& value = *measured.value;
  const int digits = digits_for(0.0, value.median);
  const std::string after = unit.empty() ? "" : " " + unit;
  if (measured.n == 0) {
    return rounded(value.median, digits) + after + ", computed";
  }
  if (measured.n == 1) {
    return rounded(value.median, digits) + after + ", n 1";
  }
  return rounded(value.median, digits) + " [" + rounded(value.lo, digits) + ", " +
         rounded(value.hi, digits) + "]" + after + ", n " + std::to_string(measured.n);
}

}  // namespace flyball
