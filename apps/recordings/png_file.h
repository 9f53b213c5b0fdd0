// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// PNG files of cameras.

#include "flyball/runtime/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace flyball {

/// Row by row; `channels` values a pixel, of 8 or 16 bits.
struct PngPixels {
  int width_px{};
  int height_px{};
  int channels{};  ///< 1 grey, 3 red, green, blue; transparency is dropped.
  int bits{};
  std::vector<std::uint8_t> bytes{};  ///< Two a value, the higher one first, when `bits` is 16.
};

/// As they are in the file: no gamma, no scaling.
/// @error `invalid_input` when the file is missing or is no whole PNG.
[[nodiscard]] Result<PngPixels> read_png(const std::string& file);

}  // namespace flyball
