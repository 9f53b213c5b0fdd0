// SPDX-License-Identifier: BSD-3-Clause
// tested-in: results

#include "flyball/studies/comparison.h"

#include "experiments/framework/results.h"

namespace flyball {
namespace {

/// One line in a table's cell.
std::string markdown_cell(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    safe += letter == '|' ? "\\|" : std::string(1, letter == '\n' ? ' ' : letter);
  }
  return " " + safe + " |";
}

std::string markdown_claims(const Findings& findings) {
  std::string table =
      "| figure | paper | ours: median [95 %], n | verdict | cause, as tested |\n"
      "|---|---|---|---|---|\n";
  for (const Claim& claim : findings.claims) {
    table += "|" + markdown_cell(claim.what) + markdown_cell(paper_text(claim)) +
             markdown_cell(measured_text(claim.ours, claim.unit)) +
             markdown_cell(to_string(verdict_of(claim))) + markdown_cell(cause_text(claim)) + "\n";
  }
  return table + "\n";
}

std::string markdown_section(const ExperimentResult& result) {
  const Experiment& experiment = result.named.experiment;
  std::string text =
      "## " + result.named.name + ": " + experiment.title + "\n\n" + experiment.method + "\n\n";
  if (!result.trouble.empty()) {
    return text + result.trouble + "\n\n";
  }
  text += markdown_claims(result.findings);
  for (const std::string& note : result.findings.notes) {
    text += note + "\n\n";
  }
  for (const auto& [name, sweep] : result.sweeps) {
    text += "- " + name + ", " + std::to_string(sweep.flights.size()) + " flights, seeds " +
            seeds_text(sweep.plan.seeds) + ": `" + result.commands.at(name) + "`\n";
  }
  return text + "\n";
}

}  // namespace

std::string experiments_markdown(const std::vector<ExperimentResult>& results) {
  std::string page = "# What was measured\n\nWritten by `flyball reproduce";
  for (const ExperimentResult& result : results) {
    page += " " + result.named.name;
  }
  page +=
      "`. Medians with 95 % bootstrap intervals, ratios over pairs of flights with the same "
      "seed; README of `apps/experiments` says what a verdict means.\n\n";
  for (const ExperimentResult& result : results) {
    page += markdown_section(result);
  }
  page.pop_back();  // The empty line after the last section.
  return page;
}

}  // namespace flyball
