// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One figure over two settings: a coloured cell for each pair of values, with the number in it.

#include "flyball/studies/statistics.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

struct HeatCell {
  std::optional<MedianInterval> value{};  ///< Empty: nothing to show.
  std::string under{};                    ///< A second line: how many flights, say.
};

struct HeatMap {
  std::string title{};
  std::string x_title{};
  std::string y_title{};
  std::vector<std::string> x_values{};
  std::vector<std::string> y_values{};  ///< From bottom to top.
  std::vector<HeatCell> cells{};        ///< Row by row, from the bottom: `cells[y * x_values + x]`.
  /// Of the colours; several maps of one figure share them, so that they can be compared.
  double low{};
  double high{1.0};
};

/// @pre `cells` has one for each pair of values.
[[nodiscard]] std::string heat_map_svg(const HeatMap& map);

/// As many digits after the point as tell values of this span apart, but at most four that count.
[[nodiscard]] int digits_for(double low, double high);

}  // namespace flyball
