// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A 16-bit image as a program writes it into a pipe.

#include <cstdint>
#include <string>
#include <vector>

namespace flyball::kit {

inline std::string pgm_bytes(int width_px,
                             int height_px,
                             const std::vector<std::uint16_t>& values) {
  std::string bytes =
      "P5\n" + std::to_string(width_px) + " " + std::to_string(height_px) + "\n65535\n";
  for (const std::uint16_t value : values) {
    bytes.push_back(static_cast<char>(value >> 8U));
    bytes.push_back(static_cast<char>(value & 0xffU));
  }
  return bytes;
}

}  // namespace flyball::kit
