// SPDX-License-Identifier: BSD-3-Clause
// tested-in: recording

#include "recordings/png_file.h"

#include <csetjmp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <png.h>

namespace flyball {
namespace {

constexpr png_uint_32 most_px = 8192;

struct CloseFile {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};

/// libpng's two structures, released together.
struct Decoder {
  // libpng's own handlers print; these are silent, and the caller says what is wrong.
  Decoder()
      : png{png_create_read_struct(
            PNG_LIBPNG_VER_STRING,
            nullptr,
            [](png_structp at, png_const_charp) { png_longjmp(at, 1); },
            [](png_structp, png_const_charp) {})},
        info{png != nullptr ? png_create_info_struct(png) : nullptr} {}
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  png_structp png;
  png_infop info;
};

/// False when libpng jumped back: nothing here may need a destructor.
bool read_header(const Decoder& decoder, std::FILE* file, PngPixels& pixels) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) {  // NOLINT(cert-err52-cpp): libpng's way
    return false;
  }
  // The header's size is believed: so much memory is taken before a pixel is read.
  png_set_user_limits(decoder.png, most_px, most_px);
  png_init_io(decoder.png, file);
  png_read_info(decoder.png, decoder.info);
  png_set_expand(decoder.png);  // Palettes and fewer than 8 bits.
  png_set_strip_alpha(decoder.png);
  (void)png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
  pixels.width_px = static_cast<int>(png_get_image_width(decoder.png, decoder.info));
  pixels.height_px = static_cast<int>(png_get_image_height(decoder.png, decoder.info));
  pixels.channels = png_get_channels(decoder.png, decoder.info);
  pixels.bits = png_get_bit_depth(decoder.png, decoder.info);
  return true;
}

bool read_rows(const Decoder& decoder, png_bytepp rows) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) {  // NOLINT(cert-err52-cpp): libpng's way
    return false;
  }
  png_read_image(decoder.png, rows);
  return true;
}

}  // namespace

Result<PngPixels> read_png(const std::string& file) {
  const Error unreadable{
      ErrorCode::invalid_input,
      "cannot read \"" + file + "\" as a PNG image of at most 8192 x 8192 pixels"};
  // A pipe or a device may never end.
  if (std::error_code failed; !std::filesystem::is_regular_file(file, failed)) {
    return unreadable;
  }
  const std::unique_ptr<std::FILE, CloseFile> source{std::fopen(file.c_str(), "rb")};
  const Decoder decoder;
  PngPixels pixels;
  if (!source || decoder.info == nullptr || !read_header(decoder, source.get(), pixels)) {
    return unreadable;
  }
  const std::size_t stride = png_get_rowbytes(decoder.png, decoder.info);
  pixels.bytes.resize(stride * static_cast<std::size_t>(pixels.height_px));
  std::vector<png_bytep> rows;
  rows.reserve(static_cast<std::size_t>(pixels.height_px));
  for (int row = 0; row < pixels.height_px; ++row) {
    rows.push_back(&pixels.bytes[stride * static_cast<std::size_t>(row)]);
  }
  if (!read_rows(decoder, rows.data())) {
    return unreadable;
  }
  return pixels;
}

}  // namespace flyball
