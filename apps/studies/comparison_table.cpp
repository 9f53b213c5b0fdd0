// SPDX-License-Identifier: BSD-3-Clause
// tested-in: comparison

#include "flyball/records/text_table.h"
#include "flyball/runtime/text/listed.h"
#include "flyball/studies/comparison.h"

#include <algorithm>
#include <array>
#include <vector>

namespace flyball {
namespace {

using Cells = std::vector<std::string>;

/// A column of the table: how a median is scaled and rounded.
struct Column {
  const char* title;
  std::optional<MedianInterval> ComparisonRow::*value;
  double scale;
  int digits;
};

constexpr std::array<Column, 7> columns{{
    {"time s", &ComparisonRow::mission_time_s, 1.0, 1},
    {"energy kJ", &ComparisonRow::energy_total_j, 1e-3, 1},
    {"battery %", &ComparisonRow::battery_used_percent, 1.0, 1},
    {"speed m/s", &ComparisonRow::mean_speed_m_s, 1.0, 2},
    {"latency ms", &ComparisonRow::latency_p50_s, 1e3, 0},
    {"battery ratio", &ComparisonRow::battery_ratio, 1.0, 2},
    {"time ratio", &ComparisonRow::time_ratio, 1.0, 2},
}};

/// A median, and its interval or nothing where it says nothing more: one flight, or all alike to
/// the digits that are shown.
struct Figure {
  std::string median;
  std::string interval{};
};

Figure figure(const ComparisonRow& row, const Column& column) {
  const std::optional<MedianInterval>& value = row.*column.value;
  if (!value) {
    return {"-"};
  }
  const auto show = [&](double x) { return rounded(x * column.scale, column.digits); };
  const std::string lo = show(value->lo);
  const std::string hi = show(value->hi);
  return {show(value->median), lo == hi ? "" : "[" + lo + ", " + hi + "]"};
}

std::string counts(const ComparisonRow& row) {
  return std::to_string(row.succeeded) + "/" + std::to_string(row.n);
}

Cells header() {
  Cells cells{"policy", "success", "collisions"};
  for (const Column& column : columns) {
    cells.emplace_back(column.title);
  }
  return cells;
}

Cells cells_of(const ComparisonRow& row) {
  Cells cells{row.policy, counts(row), std::to_string(row.collisions)};
  for (const Column& column : columns) {
    const Figure shown = figure(row, column);
    cells.push_back(shown.median + (shown.interval.empty() ? "" : " ") + shown.interval);
  }
  return cells;
}

std::string failures_text(const ComparisonRow& row) {
  return listed(row.failures, [](const auto& failure) {
    return failure.first + " " + std::to_string(failure.second);
  });
}

std::string meaning(const Comparison& comparison) {
  return "Median [95 % bootstrap interval] over succeeded flights only, seeds " +
         seeds_text(comparison.seeds) + "; failed flights are listed by failure. Ratios are to " +
         comparison.rows.front().policy + " over the seeds where both succeed.";
}

}  // namespace

std::string to_text(const Comparison& comparison) {
  std::vector<Cells> lines{header()};
  std::string failed;
  for (const ComparisonRow& row : comparison.rows) {
    lines.push_back(cells_of(row));
    if (!row.failures.empty()) {
      failed += row.policy + " failed: " + failures_text(row) + "\n";
    }
    if (const std::string trouble = row.trouble.text(row.policy); !trouble.empty()) {
      failed += trouble + "\n";
    }
  }
  return comparison.scenario + "\n" + aligned(lines) + failed + meaning(comparison) + "\n";
}

std::string to_html(const Comparison& comparison) {
  std::string rows = "<tr>";
  std::string troubles;
  for (const std::string& title : header()) {
    rows += "<th>" + title + "</th>";
  }
  for (const ComparisonRow& row : comparison.rows) {
    rows += "</tr>\n<tr><td>" + html_text(row.policy) + "</td><td>" + counts(row) + "<small>" +
            failures_text(row) + "</small></td><td>" + std::to_string(row.collisions) + "</td>";
    for (const Column& column : columns) {
      const Figure shown = figure(row, column);
      rows += "<td>" + shown.median + "<small>" + shown.interval + "</small></td>";
    }
    if (const std::string trouble = row.trouble.text(row.policy); !trouble.empty()) {
      troubles += "<p class=\"note\">" + html_text(trouble) + "</p>\n";
    }
  }
  return html_table(rows + "</tr>") + troubles + "<p class=\"note\">" +
         html_text(meaning(comparison)) + "</p>\n";
}

}  // namespace flyball
