// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/results.h"

#include "flyball/records/text_table.h"

#include "studies/plots/csv.h"
#include <array>
#include <cstdio>

namespace flyball {
namespace {

/// As the paper prints it, 1.8 and not 1.800; a ratio of two of its numbers has four digits.
std::string four_digits(double value) {
  std::array<char, 32> text{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): streams need four calls for the same
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string claim_row(const std::string& experiment, const Claim& claim) {
  const auto& ours = claim.ours.value;
  return csv_row({experiment, claim.what, claim.unit,
                  claim.paper ? csv_number(claim.paper->value) : "",
                  claim.paper ? claim.paper->where : "", ours ? csv_number(ours->median) : "",
                  ours ? csv_number(ours->lo) : "", ours ? csv_number(ours->hi) : "",
                  std::to_string(claim.ours.n), to_string(verdict_of(claim)), cause_text(claim)});
}

}  // namespace

void evaluate(ExperimentResult& result) {
  Result<Findings> findings = result.named.experiment.evaluate(Evidence{result.sweeps});
  if (!findings) {
    result.trouble = findings.error().message;
  } else if (findings->claims.empty()) {
    result.trouble = "experiment \"" + result.named.name + "\" makes no claim";
  } else {
    result.findings = std::move(*findings);
  }
}

std::string paper_text(const Claim& claim) {
  if (!claim.paper) {
    return "-";
  }
  std::string number =
      four_digits(claim.paper->value) + (claim.unit.empty() ? "" : " " + claim.unit);
  switch (claim.match) {
    case PaperMatch::at_least:
      return "at least " + number;
    case PaperMatch::at_most:
      return "at most " + number;
    case PaperMatch::value:
      break;
  }
  return number;
}

std::string verdict_counts(const Findings& findings) {
  std::map<Verdict, int> counts;
  for (const Claim& claim : findings.claims) {
    ++counts[verdict_of(claim)];
  }
  counts.erase(Verdict::ours);
  std::string text;
  for (const auto& [verdict, count] : counts) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + to_string(verdict);
  }
  return text;
}

std::string to_text(const std::vector<ExperimentResult>& results) {
  std::vector<std::vector<std::string>> lines{
      {"experiment", "first figure", "paper", "ours", "verdict", "all figures"}};
  for (const ExperimentResult& result : results) {
    if (!result.trouble.empty()) {
      lines.push_back({result.named.name, result.trouble, "", "", "", ""});
      continue;
    }
    const Claim& first = result.findings.claims.front();
    lines.push_back({result.named.name, first.what, paper_text(first),
                     measured_text(first.ours, first.unit), to_string(verdict_of(first)),
                     verdict_counts(result.findings)});
  }
  return aligned(lines);
}

std::string claims_csv(const std::vector<ExperimentResult>& results) {
  std::string csv = csv_row({"experiment", "figure", "unit", "paper", "where in the paper", "ours",
                             "lo", "hi", "n", "verdict", "tested causes"});
  for (const ExperimentResult& result : results) {
    for (const Claim& claim : result.findings.claims) {
      csv += claim_row(result.named.name, claim);
    }
  }
  return csv;
}

}  // namespace flyball
