// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Visual tracking: where the thing in a box went from one image to the next.

#include "flyball/runtime/colour_image.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <optional>
#include <vector>

namespace flyball {

class Tracker : public Kernel {
 public:
  /// Settings of this implementation that stay for the mission.
  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const { return {}; }
  /// Before the first `begin`. @pre `chosen` was resolved from `parameters()`.
  virtual void configure([[maybe_unused]] const Parameters& chosen) {}

  /// Learns what is in the box; what was followed before is forgotten. Adds `starts` to `work`.
  ///
  /// @error `invalid_input` for an image of the wrong size, or a box of which less than 4 x 4
  ///        pixels are inside it: nothing is followed then.
  [[nodiscard]] virtual Status begin(const ColourImage& image, const ImageBox& box, Work& work) = 0;
  /// The box in the next image; empty when the thing is not seen there, or nothing is followed. A
  /// later image may show it again. Adds `updates` to `work`.
  ///
  /// @error `invalid_input` for an image of another size than the one it began on.
  [[nodiscard]] virtual Result<std::optional<ImageBox>> update(const ColourImage& image,
                                                               Work& work) = 0;
};

}  // namespace flyball
