// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A level cut through a map, seen from above: what it knows of each place.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flyball {

enum class PlaceState : std::uint8_t {
  unknown,
  free,      ///< But the body, with its centre there, is not wholly in free space.
  passable,  ///< The whole body is in free space.
  occupied
};

[[nodiscard]] const char* to_string(PlaceState state);

/// Squares of one size; x runs to the right, y upwards.
struct CellPicture {
  std::string title{};
  double square_m{};
  double least_x_m{};  ///< Of the left edge.
  double least_y_m{};  ///< Of the lower edge.
  std::size_t columns{};
  std::vector<PlaceState> squares{};  ///< Row by row, from the bottom.

  [[nodiscard]] std::size_t rows() const { return columns == 0 ? 0 : squares.size() / columns; }
};

/// Both axes in metres, and a legend.
/// @pre `squares` holds whole rows.
[[nodiscard]] std::string cell_picture_svg(const CellPicture& picture);

}  // namespace flyball
