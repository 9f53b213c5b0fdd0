// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Plots of a sweep, with labels that a reader understands instead of settings.

#include "experiments/framework/evidence.h"
#include "experiments/framework/figure.h"
#include <string>
#include <vector>

namespace flyball {

/// How an axis is written.
struct AxisLabels {
  std::string title{};                ///< With its unit; empty: the setting.
  std::vector<std::string> values{};  ///< Empty: the values of the setting.
};

struct PlotOf {
  std::string sweep{};
  std::string title{};  ///< Of what is plotted, with its unit.
  FlightFigure figure{};
  AxisLabels x{};        ///< The last axis.
  AxisLabels y{};        ///< Of a heat map: the axis before it.
  std::string policy{};  ///< Empty: each one is a line, or the sweep's only one.
  bool counts_failed{};
};

/// @pre The sweep has two axes.
[[nodiscard]] HeatMap heat_map_of(const Evidence& evidence, const PlotOf& wanted);
/// A line for each policy over the last axis, and for each value of the axis before it, if there is
/// one.
/// @pre The sweep has one axis or two.
[[nodiscard]] LinePlot line_plot_of(const Evidence& evidence, const PlotOf& wanted);
/// A dot for each policy of a sweep: the median with its interval over the flights that succeed.
/// @param figure  A name of `flight_figure`, also of the figure's file.
/// @param title   Of what is plotted, with its unit.
[[nodiscard]] Figure policies_plot(const Evidence& evidence,
                                   const std::string& sweep,
                                   const std::string& figure,
                                   const std::string& title);
/// `Each value: 3 flights.` or `Each value: 0 to 3 flights.`, of those that count.
[[nodiscard]] std::string counts_text(const Evidence& evidence, const PlotOf& wanted);

}  // namespace flyball
