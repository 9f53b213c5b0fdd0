// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A dense window of one byte per cell around a scan, in which rays leave marks.
///
/// A cell's place is put together from the bits of its three offsets: first two bits of each axis,
/// which say where the cell is in its brick, then the bricks' bits, x lowest. So a brick is one
/// cache line, and a step along one axis is an addition that carries across the other axes' bits.

#include "scans/scan_masks.h"
#include <array>
#include <cstdint>
#include <vector>

namespace flyball {

class MarkWindow {
 public:
  static constexpr std::uint8_t free_mark = 1;
  static constexpr std::uint8_t hit_mark = 2;

  /// Covers the cells from `first` to `last`, both included. All marks are gone.
  /// @pre At most 1024 cells along each axis.
  void span(const CellKey& first, const CellKey& last);
  [[nodiscard]] std::uint32_t place(const CellKey& cell) const {
    return spread(0, cell.x) | spread(1, cell.y) | spread(2, cell.z);
  }
  /// The part of a place that an axis decides, and the step along that axis.
  [[nodiscard]] std::uint32_t spread(std::size_t axis, int key) const {
    const auto offset = static_cast<std::uint32_t>(key - 4 * first_brick_[axis]);
    return (offset & 3U) << 2 * axis | offset >> 2U << brick_shift_[axis];
  }
  [[nodiscard]] std::uint32_t bits(std::size_t axis) const { return bits_[axis]; }
  static std::uint32_t unit(std::size_t axis) { return 1U << 2 * axis; }

  /// One byte for each place.
  [[nodiscard]] std::uint8_t* marks() {
    return reinterpret_cast<std::uint8_t*>(lines_.data());  // NOLINT: bytes of the lines
  }
  /// Appends the bricks with marks, wipes them, and returns how many cells these are.
  std::size_t collect(std::vector<BrickMasks>& bricks);

 private:
  /// The marks of a brick; a row is eight cells.
  struct alignas(64) Line {
    std::array<std::uint64_t, 8> rows;
  };
  std::size_t collect_chunk(const CellKey& chunk, std::vector<BrickMasks>& bricks);
  static BrickMasks masks_of(const Line& line);

  std::vector<Line> lines_{};  ///< Only grows; without marks between two scans.
  std::array<int, 3> first_brick_{};
  std::array<int, 3> bricks_{};  ///< Along each axis; the lines beyond them stay untouched.
  std::array<unsigned, 3> brick_shift_{};
  std::array<std::uint32_t, 3> bits_{};
};

}  // namespace flyball
