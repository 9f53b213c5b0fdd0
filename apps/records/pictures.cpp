// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/records/pictures.h"

#include "flyball/kernels/module.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <png.h>

namespace flyball {
namespace {

namespace fs = std::filesystem;

using OpenPictures = PictureReader* (*)(const char* path);

/// Null when the module is not there.
OpenPictures load_module() {
  void* entry = module_function("pictures", "flyball_open_pictures");
  return reinterpret_cast<OpenPictures>(entry);  // NOLINT: what dlsym is for
}

}  // namespace

Result<std::unique_ptr<PictureReader>> open_pictures(const std::string& path) {
  if (std::error_code failed; !fs::exists(path, failed)) {
    return Error{ErrorCode::not_found, "no file or folder \"" + path + "\" to read pictures from"};
  }
  const OpenPictures open = load_module();
  if (open == nullptr) {
    return Error{ErrorCode::unavailable, "this build reads no pictures: no module \"" +
                                             module_path("pictures") +
                                             "\"; install libopencv-dev and build it again"};
  }
  std::unique_ptr<PictureReader> reader{open(path.c_str())};
  if (!reader) {
    return Error{ErrorCode::invalid_input,
                 "\"" + path + "\" is no picture, no video and no folder of pictures"};
  }
  return reader;
}

Result<std::string> png_of(const ColourImage& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.camera.width_px);
  header.height = static_cast<png_uint_32>(image.camera.height_px);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t bytes = 0;
  const bool measured =
      png_image_write_to_memory(&header, nullptr, &bytes, 0, image.rgb.data(), 0, nullptr) != 0;
  std::string content(bytes, '\0');
  if (!measured || png_image_write_to_memory(&header, content.data(), &bytes, 0, image.rgb.data(),
                                             0, nullptr) == 0) {
    return Error{ErrorCode::failed, std::string{"no PNG file: "} + &header.message[0]};
  }
  content.resize(bytes);
  return content;
}

}  // namespace flyball
