// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One figure over one setting: a line for each policy, with the interval at each value.

#include "flyball/studies/statistics.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

struct PlottedLine {
  std::string name{};
  std::vector<std::optional<MedianInterval>> values{};  ///< One for each place; empty: a gap.
};

struct LinePlot {
  std::string title{};
  std::string x_title{};
  std::vector<std::string> places{};  ///< Numbers stand where they belong, anything else in a row.
  std::vector<PlottedLine> lines{};
  bool is_percentage{};  ///< Then the vertical axis reaches from 0 to 100.
};

/// The vertical axis of other figures need not begin at zero.
[[nodiscard]] std::string line_plot_svg(const LinePlot& plot);

}  // namespace flyball
