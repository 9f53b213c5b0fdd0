// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/colour_frame.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <mutex>

namespace flyball {
namespace {

// What was rendered is known by squares of so many pixels: fine enough beside a window of some
// hundred, and a multiple of the tiles that renderers trace at once.
constexpr int square_px = 8;

int squares(int pixels) {
  return (pixels + square_px - 1) / square_px;
}

}  // namespace

struct DeferredImage::Shared {
  std::mutex mutex{};
  Render render{};  ///< Empty: the picture is whole.
  ColourImage image{};
  std::vector<char> is_there{};  ///< By square, row by row; made at the first look.

  void need(const PixelRegion& region);

 private:
  [[nodiscard]] std::vector<PixelRegion> take_missing(const PixelRegion& region);
};

/// The squares that `region` touches and nobody asked for yet, joined along each row.
std::vector<PixelRegion> DeferredImage::Shared::take_missing(const PixelRegion& region) {
  const int columns = squares(image.camera.width_px);
  std::vector<PixelRegion> missing;
  for (int row = region.y_px / square_px; row < squares(region.y_px + region.height_px); ++row) {
    bool joins = false;
    for (int column = region.x_px / square_px; column < squares(region.x_px + region.width_px);
         ++column) {
      char& there = is_there[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                             static_cast<std::size_t>(column)];
      if (there != 0) {
        joins = false;
        continue;
      }
      there = 1;
      if (!joins) {
        missing.push_back({column * square_px, row * square_px, 0, square_px});
        joins = true;
      }
      missing.back().width_px += square_px;
    }
  }
  for (PixelRegion& each : missing) {  // The last row and column may be cut off by the edge.
    each.width_px = std::min(each.width_px, image.camera.width_px - each.x_px);
    each.height_px = std::min(each.height_px, image.camera.height_px - each.y_px);
  }
  return missing;
}

void DeferredImage::Shared::need(const PixelRegion& region) {
  const Intrinsics& camera = image.camera;
  FLYBALL_ASSERT(whole(camera).covers(region),
                 "%d x %d pixels from (%d, %d) of an image of %d x %d", region.width_px,
                 region.height_px, region.x_px, region.y_px, camera.width_px, camera.height_px);
  if (!render || region.is_empty()) {
    return;
  }
  if (is_there.empty()) {
    image.rgb.resize(3 * static_cast<std::size_t>(camera.width_px) *
                     static_cast<std::size_t>(camera.height_px));
    is_there.resize(static_cast<std::size_t>(squares(camera.width_px)) *
                    static_cast<std::size_t>(squares(camera.height_px)));
  }
  const auto missing = take_missing(region);
  if (!missing.empty()) {
    render(missing, image);
  }
  if (std::find(is_there.begin(), is_there.end(), 0) == is_there.end()) {
    render = nullptr;
  }
}

DeferredImage::DeferredImage() : shared_{std::make_shared<Shared>()} {}

DeferredImage::DeferredImage(ColourImage blank, Render render) : DeferredImage{} {
  shared_->image = std::move(blank);
  shared_->render = std::move(render);
}

DeferredImage DeferredImage::of(ColourImage image) {
  return {std::move(image), nullptr};
}

const ColourImage& DeferredImage::value() const {
  const std::lock_guard<std::mutex> lock{shared_->mutex};
  shared_->need(whole(shared_->image.camera));
  return shared_->image;
}

ColourPatch DeferredImage::part(const PixelRegion& region) const {
  const std::lock_guard<std::mutex> lock{shared_->mutex};
  shared_->need(region);
  return cut(shared_->image, region);
}

}  // namespace flyball
