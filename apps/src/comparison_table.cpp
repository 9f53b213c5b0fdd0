// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/apps/comparison.h"

#include "html.h"
#include <algorithm>
#include <array>
#include <cstdio>
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

std::string rounded(double value, int digits) {
  std::array<char, 40> text{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): streams need four calls for the same
  const int size = std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return {text.data(), static_cast<std::size_t>(std::max(0, size))};
}

std::string cell(const ComparisonRow& row, const Column& column) {
  const std::optional<MedianInterval>& value = row.*column.value;
  if (!value) {
    return "-";
  }
  const auto show = [&](double x) { return rounded(x * column.scale, column.digits); };
  if (value->lo == value->hi) {  // One flight, or all alike: the interval says nothing more.
    return show(value->median);
  }
  return show(value->median) + " [" + show(value->lo) + ", " + show(value->hi) + "]";
}

Cells header() {
  Cells cells{"policy", "success", "collisions"};
  for (const Column& column : columns) {
    cells.emplace_back(column.title);
  }
  return cells;
}

Cells cells_of(const ComparisonRow& row) {
  Cells cells{row.policy, std::to_string(row.succeeded) + "/" + std::to_string(row.n),
              std::to_string(row.collisions)};
  for (const Column& column : columns) {
    cells.push_back(cell(row, column));
  }
  return cells;
}

std::string aligned(const std::vector<Cells>& lines) {
  std::string text;
  std::vector<std::size_t> widths(lines.front().size());
  for (const Cells& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      widths[i] = std::max(widths[i], line[i].size());
    }
  }
  for (const Cells& line : lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      text += line[i] + std::string(widths[i] - line[i].size() + 2, ' ');
    }
    text += line.back() + "\n";
  }
  return text;
}

std::string failures_text(const ComparisonRow& row) {
  std::string text;
  for (const auto& [name, count] : row.failures) {
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
  }
  return text;
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
  }
  return comparison.scenario + "\n" + aligned(lines) + failed + meaning(comparison) + "\n";
}

std::string to_html(const Comparison& comparison) {
  const auto line = [](const Cells& cells, const std::string& tag) {
    std::string text;
    for (const std::string& content : cells) {
      text += "<" + tag + ">" + html_text(content) + "</" + tag + ">";
    }
    return "<tr>" + text + "</tr>\n";
  };
  Cells titles = header();
  titles.emplace_back("failures");
  std::string table = "<table>\n" + line(titles, "th");
  for (const ComparisonRow& row : comparison.rows) {
    Cells cells = cells_of(row);
    cells.push_back(failures_text(row));
    table += line(cells, "td");
  }
  return table + "</table>\n<p class=\"note\">" + html_text(meaning(comparison)) + "</p>\n";
}

}  // namespace flyball
