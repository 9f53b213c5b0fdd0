// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Pictures and video from files, one frame after the other; pictures to files, with boxes.

#include "flyball/runtime/colour_image.h"
#include "flyball/runtime/result.h"

#include <memory>
#include <optional>
#include <string>

namespace flyball {

struct Picture {
  std::string file;
  std::uint64_t frame{};  ///< Of a video, from 0; 0 for a picture.
  ColourImage image{};    ///< Of an unknown camera: its focal length is zero.
};

class PictureReader {
 public:
  PictureReader() = default;
  PictureReader(const PictureReader&) = delete;
  PictureReader& operator=(const PictureReader&) = delete;
  virtual ~PictureReader() = default;
  /// The next one; empty behind the last.
  /// @error A file that is no picture.
  [[nodiscard]] virtual Result<std::optional<Picture>> next() = 0;
};

/// @param path  A picture, a video, or a folder, of which every picture is read in order of name.
/// @error `not_found`, `invalid_input` (neither picture nor video), `unavailable` (this build came
///        without OpenCV's readers).
[[nodiscard]] Result<std::unique_ptr<PictureReader>> open_pictures(const std::string& path);

/// The image as a PNG file's content. @pre It has a pixel.
[[nodiscard]] Result<std::string> png_of(const ColourImage& image);

}  // namespace flyball
