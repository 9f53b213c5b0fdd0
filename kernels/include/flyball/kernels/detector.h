// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Detection of people: colour image in, boxes out.

#include "flyball/runtime/colour_image.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <vector>

namespace flyball {

struct Detection {
  ImageBox box{};
  double score{};  ///< Higher is surer; its range is the detector's own.
};

class Detector : public Kernel {
 public:
  /// The size of the image in which people are looked for.
  [[nodiscard]] std::vector<KnobSpec> knobs() const override {
    return {{"detector.scale",
             "1",
             "detect",
             {},
             0.25,
             4.0,
             1.0,
             "size of the image in which people are looked for, over the camera's"}};
  }
  /// People in the image, surest first; none is a result too.
  ///
  /// @param scale  The image is resized by it before anything is looked for: smaller is cheaper,
  ///               larger finds people who are farther away. Boxes are in pixels of `image`.
  /// @return       Adds `images` (one), `pixels` (of the resized image, at all sizes looked at) and
  /// what dominates to `work`: `windows`
  ///               looked at, or `multiply_adds` of a network.
  /// @error        `invalid_input` if the image is empty, or not of the size that its camera says,
  ///               or the scale is not in (0, 8].
  [[nodiscard]] virtual Result<std::vector<Detection>> detect(const ColourImage& image,
                                                              double scale,
                                                              Work& work) = 0;
};

}  // namespace flyball
