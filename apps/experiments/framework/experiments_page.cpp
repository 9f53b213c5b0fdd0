// SPDX-License-Identifier: BSD-3-Clause
// tested-in: results

#include "flyball/records/text_table.h"
#include "flyball/studies/comparison.h"

#include "experiments/framework/fitted.h"
#include "experiments/framework/results.h"
#include "studies/plots/page.h"
#include <algorithm>

namespace flyball {
namespace {

constexpr const char* look = R"(<style>
  h2 { margin-top: 34px; border-top: 2px solid #dfe5ea; padding-top: 18px; }
  body { max-width: 1400px; }
  td.text, td small { white-space: normal; }
  td.text, th.text { text-align: left; min-width: 9em; }
  .verdict { display: inline-block; border-radius: 9px; padding: 0 9px; white-space: nowrap;
             background: #e8ecf0; }
  .reproduced { background: #cdeadb; } .same_trend { background: #fbeab8; }
  .not_reproduced { background: #f6cfc6; }
  figure { margin: 10px 0 18px; } figcaption { color: #6b7a88; font-size: 12.5px; }
  figure svg { max-width: 100%; height: auto; }
  code { font-size: 12px; overflow-wrap: anywhere; white-space: normal; }
  @media print { h2 { break-before: page; border: 0; } td.text, th.text { min-width: 0; }
                 body { max-width: none; } .verdict { white-space: normal; padding: 0 4px; } }
</style>
)";

std::string chip(Verdict verdict) {
  std::string name = to_string(verdict);
  std::string style = name;
  std::replace(style.begin(), style.end(), ' ', '_');
  return "<span class=\"verdict " + style + "\">" + name + "</span>";
}

std::string cell(const std::string& text) {
  return "<td>" + html_text(text) + "</td>";
}

std::string text_cell(const std::string& text) {
  return "<td class=\"text\">" + html_text(text) + "</td>";
}

/// Whether the claim is off by more than the verdict's tolerance, so that it owes a cause.
bool owes_cause(const Claim& claim) {
  const Verdict verdict = verdict_of(claim);
  return verdict == Verdict::same_trend || verdict == Verdict::not_reproduced;
}

std::string cause_of(const Claim& claim) {
  const std::string tested = cause_text(claim);
  return tested.empty() && owes_cause(claim) ? "no cause tested" : tested;
}

std::string overview_row(const ExperimentResult& result) {
  const Experiment& experiment = result.named.experiment;
  const std::string name = "<tr><td class=\"text\"><a href=\"#" + result.named.name + "\">" +
                           result.named.name + "</a><small>" + html_text(experiment.title) +
                           "</small></td>";
  if (!result.trouble.empty()) {
    return name + "<td class=\"text\" colspan=\"6\">" + html_text(result.trouble) + "</td></tr>\n";
  }
  const Claim& first = result.findings.claims.front();
  return name + text_cell(first.what) + cell(paper_text(first)) +
         cell(measured_text(first.ours, first.unit)) + "<td>" + chip(verdict_of(first)) + "</td>" +
         text_cell(verdict_counts(result.findings)) + text_cell(cause_of(first)) + "</tr>\n";
}

std::string overview(const std::vector<ExperimentResult>& results) {
  std::string rows =
      "<tr><th class=\"text\">experiment</th><th class=\"text\">its first figure</th><th>paper</th>"
      "<th>ours</th><th>verdict</th><th class=\"text\">all its figures</th>"
      "<th class=\"text\">cause, as tested</th></tr>\n";
  for (const ExperimentResult& result : results) {
    rows += overview_row(result);
  }
  return "<div class=\"panel\">" + html_table(rows) +
         "<p class=\"note\">Reproduced: our median is within 25 % of the paper's number. Same "
         "trend: it is off by more, but on the same side of no effect, with its whole interval. "
         "Ours: the paper prints no number. A cause is the same measurement with one thing "
         "changed; a gap is the logarithm of the paper's number over ours.</p></div>\n";
}

std::string fitted_table() {
  const auto fitted = fitted_values();
  if (!fitted) {
    return "<p>" + html_text(fitted.error().message) + "</p>\n";
  }
  std::string rows =
      "<tr><th class=\"text\">what</th><th class=\"text\">value</th><th class=\"text\">fitted to"
      "</th><th class=\"text\">in</th></tr>\n";
  for (const Fitted& each : *fitted) {
    rows += "<tr>" + text_cell(each.what) + text_cell(each.value) + text_cell(each.to) +
            text_cell(each.where) + "</tr>\n";
  }
  return "<h2>What was ever fitted, and to what</h2>\n<div class=\"panel\">" + html_table(rows) +
         "<p class=\"note\">Everything else comes from data sheets, published code or "
         "measurements, as the files say.</p></div>\n";
}

std::string claims_table(const Findings& findings) {
  std::string rows =
      "<tr><th class=\"text\">figure</th><th>paper</th><th>ours: median [95 %], n</th>"
      "<th>verdict</th><th class=\"text\">cause, as tested</th></tr>\n";
  for (const Claim& claim : findings.claims) {
    const std::string where =
        claim.paper ? "<small>" + html_text(claim.paper->where) + "</small>" : "";
    rows += "<tr>" + text_cell(claim.what) + "<td>" + html_text(paper_text(claim)) + where +
            "</td>" + cell(measured_text(claim.ours, claim.unit)) + "<td>" +
            chip(verdict_of(claim)) + "</td>" + text_cell(cause_of(claim)) + "</tr>\n";
  }
  return html_table(rows);
}

std::string sweeps_of(const ExperimentResult& result) {
  std::string content;
  for (const auto& [name, sweep] : result.sweeps) {
    content += "<li>" + html_text(name) + ": " + std::to_string(sweep.flights.size()) +
               " flights, seeds " + html_text(seeds_text(sweep.plan.seeds)) + "<br><code>" +
               html_text(result.commands.at(name)) + "</code></li>\n";
  }
  return content.empty() ? "<p class=\"note\">Computed, without flights.</p>\n"
                         : "<h3>Flights, and the command that flies them alone</h3>\n<ul>" +
                               content + "</ul>\n";
}

std::string section(const ExperimentResult& result) {
  const Experiment& experiment = result.named.experiment;
  std::string content = "<h2 id=\"" + result.named.name + "\">" + result.named.name + ": " +
                        html_text(experiment.title) + "</h2>\n<p>" + html_text(experiment.method) +
                        "</p>\n<p class=\"note\">" +
                        (experiment.source.empty() ? "An experiment of ours."
                                                   : "Source: " + html_text(experiment.source)) +
                        "</p>\n";
  for (const std::string& fitted : experiment.fitted) {
    content += "<p class=\"note\">Fitted: " + html_text(fitted) + "</p>\n";
  }
  if (!result.trouble.empty()) {
    return content + "<p>" + html_text(result.trouble) + "</p>\n";
  }
  content += "<div class=\"panel\">" + claims_table(result.findings);
  for (const std::string& note : result.findings.notes) {
    content += "<p>" + html_text(note) + "</p>\n";
  }
  content += "</div>\n<div class=\"panel\">";
  for (const Figure& figure : result.findings.figures) {
    content += to_html(figure);
  }
  return content + sweeps_of(result) + "</div>\n";
}

}  // namespace

std::string experiments_page(const std::vector<ExperimentResult>& results, std::size_t seeds) {
  std::string page = page_begin("Figures of the papers, and ours") + look + "<p>" +
                     std::to_string(seeds) + (seeds == 1 ? " seed" : " seeds") +
                     " for each flight, except where an experiment takes fewer. Flights are "
                     "simulated in closed loop on a modeled computer.</p>\n" +
                     overview(results) + fitted_table();
  for (const ExperimentResult& result : results) {
    page += section(result);
  }
  return page + page_end(
                    "Medians with 95 % bootstrap intervals over succeeded flights; below six "
                    "values an interval is their whole range. CSV files stand beside this page.");
}

}  // namespace flyball
