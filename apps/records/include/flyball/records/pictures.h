// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Reads pictures and video from files, one frame after the other, and writes pictures to files.

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
  std::string trouble{};  ///< Why the file cannot be read, in one sentence; then there is no image.
};

class PictureReader {
 public:
  PictureReader() = default;
  PictureReader(const PictureReader&) = delete;
  PictureReader& operator=(const PictureReader&) = delete;
  virtual ~PictureReader() = default;
  /// The next one; empty behind the last. After one that cannot be read the others follow.
  /// @error A video that breaks off.
  [[nodiscard]] virtual Result<std::optional<Picture>> next() = 0;
};

/// @param path  A picture, a video, or a folder, of which every picture is read in order of name,
///              also those that are pictures by their name only.
/// @error `not_found`, `invalid_input` (neither picture nor video), `unavailable` (this build came
///        without OpenCV's readers).
[[nodiscard]] Result<std::unique_ptr<PictureReader>> open_pictures(const std::string& path);

/// The image as a PNG file's content. @pre It has a pixel.
[[nodiscard]] Result<std::string> png_of(const ColourImage& image);

}  // namespace flyball
