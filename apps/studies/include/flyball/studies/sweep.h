// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What settings are worth: every combination of some values, flown, and each figure over them.

#include "flyball/records/summary.h"
#include "flyball/runtime/result.h"
#include "flyball/studies/statistics.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// A setting of a scenario and the values that it gets.
struct SweepAxis {
  std::string key;  ///< `map.range_m`
  std::vector<std::string> values;
};

/// Reads `KEY=A,B,C`. A comma inside brackets, braces or quotes belongs to its value.
/// @error `invalid_input` without a key, with an empty value, or with one value twice.
[[nodiscard]] Result<SweepAxis> read_axis(const std::string& text);

/// One policy with one value of each setting; its flights differ in their seeds alone.
struct SweepPoint {
  std::string policy;
  std::vector<std::string> values;  ///< One for each axis.
  /// `map.range_m=5 camera.rate_hz=10`
  [[nodiscard]] std::string settings(const std::vector<SweepAxis>& axes) const;
};

/// All points: policy by policy, the last axis turns fastest.
[[nodiscard]] std::vector<SweepPoint> points_of(const std::vector<SweepAxis>& axes,
                                                const std::vector<std::string>& policies);

/// What a sweep is: enough to know its points.
struct SweepPlan {
  std::string scenario{};
  std::vector<SweepAxis> axes{};
  std::vector<std::string> policies{};
  std::vector<std::uint64_t> seeds{};
};

struct SweepFlight {
  std::size_t point{};    ///< Of `points_of`.
  std::string command{};  ///< That flies it again.
  Summary summary{};
};

/// The flights of a point. Medians are over its succeeded flights only.
struct SweepCell {
  SweepPoint point{};
  std::string command{};  ///< That flies all its seeds again and compares them.
  int n{};
  int succeeded{};
  std::map<std::string, int> failures{};
  std::vector<std::optional<MedianInterval>> figures{};  ///< In the order of `Sweep::figures`.
};

struct Sweep {
  SweepPlan plan{};
  std::vector<std::string> figures{};  ///< Their names end in their units.
  std::vector<SweepCell> cells{};      ///< In the order of `points_of`.
  std::vector<SweepFlight> flights{};
};

/// @param commands  One for each point.
[[nodiscard]] Sweep sweep_of(const SweepPlan& plan,
                             const std::vector<std::string>& commands,
                             std::vector<SweepFlight> flights);

/// One sentence for each policy that failed in flight and was replaced by safe settings.
[[nodiscard]] std::vector<std::string> troubles_of(const Sweep& sweep);
/// A table for a terminal: a row for each point, with the figures that people ask for first.
[[nodiscard]] std::string to_text(const Sweep& sweep);
[[nodiscard]] std::string to_json(const Sweep& sweep);
/// A row for each point: three columns for each figure, its median and interval (RFC 4180).
[[nodiscard]] std::string cells_csv(const Sweep& sweep);
/// A row for each flight.
[[nodiscard]] std::string flights_csv(const Sweep& sweep);
/// One file without network: for each figure that differs a heat map (two axes and more) or lines
/// (one axis), then the command of each cell.
[[nodiscard]] std::string sweep_page(const Sweep& sweep);

}  // namespace flyball
