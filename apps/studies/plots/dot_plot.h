// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Plots of medians with their intervals, as pictures that stand in a page.

#include "flyball/studies/statistics.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// One line of a plot.
struct PlottedValue {
  std::string name;
  std::optional<MedianInterval> value{};  ///< Empty: nothing to show.
};

/// A dot for each median, a line for its interval, one below the other from zero on.
[[nodiscard]] std::string dot_plot_svg(const std::string& title,
                                       const std::vector<PlottedValue>& values);

struct PlottedPoint {
  std::string name;
  MedianInterval x{};
  MedianInterval y{};
  bool is_best{};  ///< No other point is lower in both.
};

/// Marks the points that no other one beats in both.
void mark_best(std::vector<PlottedPoint>& points);

/// A point with both its intervals for each; those that no other one beats are joined.
[[nodiscard]] std::string pareto_plot_svg(const std::string& x_title,
                                          const std::string& y_title,
                                          std::vector<PlottedPoint> points);

}  // namespace flyball
