// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The parts that plots in a page are made of. All lengths are pixels; y grows downwards.

#include "flyball/studies/statistics.h"

#include <string>
#include <vector>

namespace flyball::svg {

/// Look of the lines behind a plot.
constexpr const char* grid = "stroke=\"#dfe5ea\"";

/// A colour for the i-th of several things; eight differ, also for most colour-blind readers.
[[nodiscard]] std::string colour(std::size_t i);
/// @param anchor  `start`, `middle` or `end`.
/// @param look    More attributes.
[[nodiscard]] std::string text(double x,
                               double y,
                               const std::string& anchor,
                               const std::string& content,
                               const std::string& look = {});
[[nodiscard]] std::string line(double x1, double y1, double x2, double y2, const std::string& look);
/// @param title  Shown while the mouse is on it.
[[nodiscard]] std::string dot(double x,
                              double y,
                              const std::string& fill,
                              const std::string& title);
struct Box {
  double x{};
  double y{};
  double width{};
  double height{};
};
[[nodiscard]] std::string rectangle(const Box& box,
                                    const std::string& look,
                                    const std::string& title);
[[nodiscard]] std::string picture(double width, double height, const std::string& content);
/// About the width of a text in the page's type.
[[nodiscard]] double width_of(const std::string& text);

/// Ticks at 1, 2 or 5 times a power of ten: two to six of them.
[[nodiscard]] double tick_step(double span);
/// With as many digits as the step needs.
[[nodiscard]] std::string number(double value, double step);

/// From values to places along one axis.
struct Scale {
  double low{};
  double high{1.0};
  double from_px{};
  double to_px{};
  [[nodiscard]] double at(double value) const {
    return from_px + (to_px - from_px) * (value - low) / (high - low);
  }
};

struct Frame {
  Scale x{};
  Scale y{};
};

/// Multiples of `tick_step` on the scale, ascending; none where it is not finite.
[[nodiscard]] std::vector<double> ticks(const Scale& scale);

/// Lines and numbers behind a plot.
[[nodiscard]] std::string axes(const Frame& frame);
/// Those of the vertical axis alone.
[[nodiscard]] std::string y_axis(const Frame& frame);

/// Covers the values with a margin, and nothing below zero.
[[nodiscard]] Scale around(double low, double high, double from_px, double to_px);

/// `fixed_fine: 12.00 [11.00, 14.50]`
[[nodiscard]] std::string interval_text(const std::string& name, const MedianInterval& value);

}  // namespace flyball::svg
