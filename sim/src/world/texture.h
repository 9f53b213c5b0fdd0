// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A picture on a surface, at several sizes.

#include "flyball/runtime/result.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace flyball {

class Texture {
 public:
  /// One colour everywhere.
  explicit Texture(const Eigen::Vector3f& colour);
  /// @param rgb  8 bits each, row by row from the top; `width * height` of them.
  Texture(int width, int height, std::vector<std::uint8_t> rgb);
  /// @error `invalid_input` for bytes that are no PNG file.
  [[nodiscard]] static Result<Texture> from_png(const void* bytes, std::size_t size);

  /// Red, green, blue, 0..1, at a place that repeats outside of 0..1; (0, 0) is the lower left.
  ///
  /// @param footprint  What one pixel of the camera covers, in widths of the picture: chooses the
  ///                   size that shows no more detail than the pixel can.
  [[nodiscard]] Eigen::Vector3f at(const Eigen::Vector2f& place, float footprint) const;
  [[nodiscard]] int width() const { return levels_.front().width; }
  [[nodiscard]] int height() const { return levels_.front().height; }

 private:
  struct Level {
    int width{};
    int height{};
    std::vector<std::uint8_t> rgb{};
    [[nodiscard]] Eigen::Vector3f pixel(int x, int y) const;
  };
  void add_smaller_levels();
  std::vector<Level> levels_;  ///< Each half as wide and high as the one before.
};

}  // namespace flyball
