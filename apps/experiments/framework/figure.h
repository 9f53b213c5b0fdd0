// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A plot of an experiment, and the same numbers as CSV.

#include "studies/plots/cell_picture.h"
#include "studies/plots/dot_plot.h"
#include "studies/plots/heat_map.h"
#include "studies/plots/line_plot.h"
#include <string>
#include <variant>
#include <vector>

namespace flyball {

/// Values one below the other.
struct DotPlot {
  std::string title{};
  std::vector<PlottedValue> values{};
};

/// A table of texts, its first row the head.
struct TextTable {
  std::string title{};
  std::vector<std::vector<std::string>> rows{};
};

struct Figure {
  std::string file{};     ///< The stem of its CSV file, once in an experiment.
  std::string caption{};  ///< How many flights each value has, and what else the reader must know.
  std::variant<LinePlot, HeatMap, DotPlot, CellPicture, TextTable> content{};
};

/// What stands in the page.
[[nodiscard]] std::string to_html(const Figure& figure);
/// A row for each value, with the ends of its interval (RFC 4180).
[[nodiscard]] std::string to_csv(const Figure& figure);

}  // namespace flyball
