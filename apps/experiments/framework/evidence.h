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

/// Of the values of a sweep's only axis, the one with the most successes and then the least energy,
/// as `is_better_in_hindsight` has it; the first of equals.
/// @param policy  As `Evidence::at`.
/// @pre `values` is not empty.
[[nodiscard]] std::string best_in_hindsight(const Evidence& evidence,
                                            const std::string& sweep,
                                            const std::vector<std::string>& values,
                                            const std::string& policy = {});

/// The median over the point's flights.
[[nodiscard]] Measured median(const Point& point, const FlightFigure& of);
/// The median of one point's number over the other's, seed by seed. Seeds that one of them lacks
/// are left out, and so are those where the number below is not positive.
[[nodiscard]] Measured ratio(const Point& over, const Point& under, const FlightFigure& of);
/// The mean time to a loss of one point over the other's, where a flight that ends without a loss
/// has only seen a part of such a time: each mean is that of an exponential distribution, all time
/// over all losses (Epstein and Sobel 1953, doi:10.1080/01621459.1953.10483488). The interval is
/// that of the ratio's logarithm as a normal distribution. All flights count. Empty where a point
/// has no loss.
[[nodiscard]] Measured mean_life_ratio(const Point& over,
                                       const Point& under,
                                       const FlightFigure& time_s,
                                       const std::function<bool(const Summary&)>& ends_in_loss);
/// Of how many flights something holds [%], with the Wilson interval of a share (1927,
/// doi:10.1080/01621459.1927.10502953). All flights count.
[[nodiscard]] Measured share_percent(const Point& point,
                                     const std::function<bool(const Summary&)>& is_so);
/// How many of the flights succeed [%].
[[nodiscard]] Measured success_percent(const Point& point);
/// The same as a claim.
/// @param whose  What flies there: `forest, mission_energy`.
[[nodiscard]] Claim success_claim(const std::string& whose, const Point& point);

}  // namespace flyball
