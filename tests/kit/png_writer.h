// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

namespace flyball::kit {

/// Grey values, row by row: 8 bits a pixel.
inline void write_png(const std::string& file,
                      int width_px,
                      int height_px,
                      const std::vector<std::uint8_t>& grey) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width_px);
  header.height = static_cast<png_uint_32>(height_px);
  header.format = PNG_FORMAT_GRAY;
  ASSERT_NE(png_image_write_to_file(&header, file.c_str(), 0, grey.data(), 0, nullptr), 0) << file;
}

/// As above, 16 bits a pixel.
inline void write_png(const std::string& file,
                      int width_px,
                      int height_px,
                      const std::vector<std::uint16_t>& values) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width_px);
  header.height = static_cast<png_uint_32>(height_px);
  header.format = PNG_FORMAT_LINEAR_Y;
  ASSERT_NE(png_image_write_to_file(&header, file.c_str(), 0, values.data(), 0, nullptr), 0)
      << file;
}

}  // namespace flyball::kit
