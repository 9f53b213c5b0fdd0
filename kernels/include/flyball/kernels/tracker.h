// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Visual tracking: where the thing in a box went from one image to the next.

#include "flyball/runtime/colour_image.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <optional>
#include <vector>

namespace flyball {

class Tracker : public Kernel {
 public:
  /// The pixels that `begin` needs to learn what is in the box: those that it reads at most.
  [[nodiscard]] virtual PixelRegion learns_from([[maybe_unused]] const ImageBox& box,
                                                const Intrinsics& camera) const {
    return whole(camera);
  }
  /// The pixels that the next `update` needs, of an image from this camera; empty when it follows
  /// nothing.
  [[nodiscard]] virtual PixelRegion looks_at(const Intrinsics& camera) const {
    return whole(camera);
  }
  /// Learns what is in the box; what was followed before is forgotten. Adds `starts` to `work`.
  ///
  /// @param patch  At least the pixels of `learns_from`. More do not change the result.
  /// @error `invalid_input` for a patch of which pixels are missing, or a box of which less than
  ///        4 x 4 pixels are inside the image: nothing is followed then.
  [[nodiscard]] virtual Status begin(const ColourPatch& patch, const ImageBox& box, Work& work) = 0;
  /// The box in the next image; empty when the thing is not seen there, or nothing is followed. A
  /// later image may show it again. Adds `updates` to `work`.
  ///
  /// @param patch  At least the pixels of `looks_at`. More do not change the result.
  /// @error `invalid_input` for an image of another size than the one it began on, or a patch of
  ///        which pixels are missing.
  [[nodiscard]] virtual Result<std::optional<ImageBox>> update(const ColourPatch& patch,
                                                               Work& work) = 0;
};

}  // namespace flyball
