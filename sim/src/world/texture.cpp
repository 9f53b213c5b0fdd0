// SPDX-License-Identifier: BSD-3-Clause
#include "world/texture.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <png.h>

namespace flyball {
namespace {

std::uint8_t byte_of(float share) {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): positive, and lround is a call for each colour
  return static_cast<std::uint8_t>(std::clamp(share, 0.0F, 1.0F) * 255.0F + 0.5F);
}

// Remainder that is never negative.
int wrapped(int i, int n) {
  const int r = i % n;
  return r < 0 ? r + n : r;
}

}  // namespace

Texture::Texture(const Eigen::Vector3f& colour)
    : levels_{{1, 1, {byte_of(colour.x()), byte_of(colour.y()), byte_of(colour.z())}}} {}

Texture::Texture(int width, int height, std::vector<std::uint8_t> rgb)
    : levels_{{width, height, std::move(rgb)}} {
  FLYBALL_ASSERT(width > 0 && height > 0 &&
                     levels_.front().rgb.size() ==
                         3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                 "%zu bytes for %d x %d pixels", levels_.front().rgb.size(), width, height);
  add_smaller_levels();
}

Result<Texture> Texture::from_png(const void* bytes, std::size_t size) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes, size) == 0) {
    return Error{ErrorCode::invalid_input, std::string{"no PNG picture: "} + &image.message[0]};
  }
  constexpr png_uint_32 most_px = 8192;  // A header of a few bytes may ask for 4e9 x 4e9.
  if (image.width > most_px || image.height > most_px) {
    png_image_free(&image);
    return Error{ErrorCode::invalid_input, "no PNG picture of at most 8192 x 8192 pixels"};
  }
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  const png_color under{128, 128, 128};  // Where the picture is transparent.
  if (png_image_finish_read(&image, &under, rgb.data(), 0, nullptr) == 0) {
    png_image_free(&image);
    return Error{ErrorCode::invalid_input, std::string{"no PNG picture: "} + &image.message[0]};
  }
  return Texture{static_cast<int>(image.width), static_cast<int>(image.height), std::move(rgb)};
}

void Texture::add_smaller_levels() {
  while (levels_.back().width > 1 && levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{fine.width / 2, fine.height / 2, {}};
    coarse.rgb.reserve(3 * static_cast<std::size_t>(coarse.width) *
                       static_cast<std::size_t>(coarse.height));
    for (int i = 0; i < coarse.width * coarse.height; ++i) {
      const int x = 2 * (i % coarse.width);
      const int y = 2 * (i / coarse.width);
      const Eigen::Vector3f mean = 0.25F * (fine.pixel(x, y) + fine.pixel(x + 1, y) +
                                            fine.pixel(x, y + 1) + fine.pixel(x + 1, y + 1));
      coarse.rgb.insert(coarse.rgb.end(),
                        {byte_of(mean.x()), byte_of(mean.y()), byte_of(mean.z())});
    }
    levels_.push_back(std::move(coarse));
  }
}

Eigen::Vector3f Texture::Level::pixel(int x, int y) const {
  const std::size_t i =
      3 * (static_cast<std::size_t>(wrapped(y, height)) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(wrapped(x, width)));
  return Eigen::Vector3f{static_cast<float>(rgb[i]), static_cast<float>(rgb[i + 1]),
                         static_cast<float>(rgb[i + 2])} /
         255.0F;
}

Eigen::Vector3f Texture::at(const Eigen::Vector2f& place, float footprint) const {
  std::size_t level = 0;
  float texels = footprint * static_cast<float>(width());
  while (texels > 1.5F && level + 1 < levels_.size()) {
    texels *= 0.5F;
    ++level;
  }
  const Level& picture = levels_[level];
  const float x = place.x() * static_cast<float>(picture.width) - 0.5F;
  const float y = (1.0F - place.y()) * static_cast<float>(picture.height) - 0.5F;
  const float x0 = std::floor(x);
  const float y0 = std::floor(y);
  const int left = static_cast<int>(x0);
  const int top = static_cast<int>(y0);
  const float u = x - x0;
  const float v = y - y0;
  return (1.0F - v) * ((1.0F - u) * picture.pixel(left, top) + u * picture.pixel(left + 1, top)) +
         v * ((1.0F - u) * picture.pixel(left, top + 1) + u * picture.pixel(left + 1, top + 1));
}

}  // namespace flyball
