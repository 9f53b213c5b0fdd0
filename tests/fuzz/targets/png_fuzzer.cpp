// SPDX-License-Identifier: BSD-3-Clause
//
// A recording's image: what libpng gives must be what was asked for.

#include "input_folder.h"
#include "recordings/png_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  const auto image = flyball::read_png(folder.write("image.png", text_of(bytes, size)));
  if (!image) {
    require(!image.error().message.empty(), "what is refused is refused in words");
    return 0;
  }
  require(image->channels == 1 || image->channels == 3, "grey, or red, green and blue");
  require(image->bits == 8 || image->bits == 16, "8 or 16 bits");
  const auto pixels =
      static_cast<std::size_t>(image->width_px) * static_cast<std::size_t>(image->height_px);
  const auto pixel_bytes = static_cast<std::size_t>(image->channels * image->bits / 8);
  require(image->bytes.size() == pixels * pixel_bytes, "as many bytes as pixels need");
  return 0;
}
