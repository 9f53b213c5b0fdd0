// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The flights of an experiment, and how its numbers are read from them.

#include "flyball/records/summary.h"
#include "flyball/studies/sweep.h"

#include "experiments/framework/claim.h"
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// The flights of one point of a sweep; they differ in their seeds alone.
struct Point {
  std::vector<const Summary*> flights{};
  /// Whether flights that failed count in medians and ratios, too.
  bool counts_failed{};
};

/// One number of a flight; empty where the flight has none.
using FlightFigure = std::function<std::optional<double>(const Summary&)>;

/// A figure of `figures_of`: `mission_time_s`, `kernel.octomap.mean_ms`, `quality.tracked_s`.
[[nodiscard]] FlightFigure flight_figure(const std::string& figure);

/// All flights of an experiment.
class Evidence {
 public:
  explicit Evidence(std::map<std::string, Sweep> sweeps) : sweeps_{std::move(sweeps)} {}

  /// @pre The experiment has a sweep of that name.
  [[nodiscard]] const Sweep& sweep(const std::string& name) const;
  /// The flights with these values of the sweep's axes.
  /// @param policy  Empty: the sweep's only one.
  /// @pre The sweep has that point.
  [[nodiscard]] Point at(const std::string& sweep,
                         const std::vector<std::string>& values,
                         const std::string& policy = {}) const;

 private:
  std::map<std::string, Sweep> sweeps_;
};

/// The median over the point's flights.
[[nodiscard]] Measured median(const Point& point, const FlightFigure& of);
/// The median of one point's number over the other's, seed by seed. Seeds that one of them lacks
/// are left out, and so are those where the number below is not positive.
[[nodiscard]] Measured ratio(const Point& over, const Point& under, const FlightFigure& of);
/// How many of the flights succeed [%]. All flights count.
[[nodiscard]] Measured success_percent(const Point& point);

}  // namespace flyball
