// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Grows a box of the brick map by a body, 64 cells at a time.
///
/// A body whose centre is somewhere in one cell can overlap another cell when the gap between the
/// two is less than its radius in the plane and less than its half height upwards. Such cells form
/// an upright prism over a disc of cells. The map's bits are dilated by it: upwards by planes that
/// are joined, along x by shifted words, along y by rows that are joined, each row of the disc with
/// its own width.

#include "flyball/kernels/inflated_window.h"

#include "brick_cells.h"
#include "scans/clear_spaces.h"
#include <vector>

namespace flyball {

/// The cells that a body in the middle one can reach: `half_width[|y|]` to either side along x, and
/// `up` upwards and downwards.
struct CellReach {
  std::vector<int> half_width{};
  int up{};

  CellReach(const Cylinder& body, double cell_m);
  [[nodiscard]] int across() const { return static_cast<int>(half_width.size()) - 1; }
};

class Inflation {
 public:
  struct Source {
    const BrickCells& map;
    const ClearSpaces& clear;
    int level;
    Obstruction by;
  };
  static constexpr int most_reach = 64;  ///< Cells; a wider body leaves an empty window.

  explicit Inflation(const Source& source) : source_{source} {}
  /// See Inflatable::inflate.
  void grow(const Aabb& box_W, const Cylinder& body, InflatedWindow& window);

 private:
  /// A box of bits. Column (plane, word) holds, for each row, its cells 64 word to 64 word + 63.
  struct Bits {
    std::size_t rows{};
    std::size_t words{};  ///< Of a row.
    std::vector<std::uint64_t> bits{};

    void resize(std::size_t planes) { bits.resize(planes * plane_size()); }
    [[nodiscard]] std::size_t plane_size() const { return words * rows; }
    [[nodiscard]] std::uint64_t* column(std::size_t plane, std::size_t word) {
      return bits.data() + plane * plane_size() + word * rows;
    }
  };

  void read(const CellKey& first, const CellKey& size);
  void read_sixteen(const CellKey& first, const CellKey& at);
  [[nodiscard]] std::uint64_t obstructed(const CellKey& brick) const;
  void join_planes(std::size_t plane, int up);
  void widen(unsigned cells);
  void join_rows(std::size_t across, std::size_t plane, InflatedWindow& window);

  Source source_;
  Bits seen_{};       ///< What the map says.
  Bits plane_{};      ///< One plane of it, while it is computed.
  Bits before_{};     ///< The same, before it was widened.
  CellKey margin_{};  ///< Bricks before the window's first. Along x it is a whole word,
  int first_near_{};  ///< of which only the bricks from this
  int last_near_{};   ///< to this are read.
};

}  // namespace flyball
