// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a colour camera publishes: pictures that are rendered as far as somebody looks.

#include "flyball/runtime/colour_image.h"

#include <functional>
#include <memory>

namespace flyball {

/// A picture of which a part is computed when somebody first looks there, and stays. Copies share
/// it. For pure computations only, as `Deferred`: a pixel is the same whoever looks, whenever, and
/// with whatever else.
class DeferredImage {
 public:
  /// Writes the pixels of all regions; may write others too, with what belongs there.
  using Render = std::function<void(const std::vector<PixelRegion>& regions, ColourImage& into)>;

  /// No pixels.
  DeferredImage();
  /// @param blank   All but the pixels.
  /// @param render  Called for what was not rendered before, one call at a time, from whichever
  ///                thread looks; released when the picture is whole. What it refers to lives until
  ///                then.
  DeferredImage(ColourImage blank, Render render);
  /// A picture that exists already.
  [[nodiscard]] static DeferredImage of(ColourImage image);

  /// The whole picture; the same at every call.
  [[nodiscard]] const ColourImage& value() const;
  /// The pixels of a region. @pre It lies inside the picture.
  [[nodiscard]] ColourPatch part(const PixelRegion& region) const;

 private:
  struct Shared;
  explicit DeferredImage(std::shared_ptr<Shared> shared) : shared_{std::move(shared)} {}
  std::shared_ptr<Shared> shared_;  ///< Owners: all copies.
};

/// A picture as the sensor publishes it.
struct ColourFrame {
  MissionTime captured{};
  std::uint64_t sequence{};
  Intrinsics camera{};
  /// Where the gimbal held the camera, by its own encoders: pose in the level frame L, which has
  /// the body's origin and heading and stands upright.
  Pose X_LC{Pose::Identity()};
  DeferredImage image{};
};

/// On a link: three bytes for each pixel.
[[nodiscard]] inline double wire_bytes(const ColourFrame& frame) {
  return 3.0 * frame.camera.width_px * frame.camera.height_px;
}

}  // namespace flyball
