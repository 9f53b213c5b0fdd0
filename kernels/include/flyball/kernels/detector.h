// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Detection of people: colour image in, boxes out.

#include "flyball/runtime/colour_image.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <functional>
#include <string>
#include <vector>

namespace flyball {

struct Detection {
  ImageBox box{};
  double score{};  ///< Higher is surer; its range is the detector's own.
};

/// Where a file lies that a detector needs and that does not come with the program (weights).
using FindModel = std::function<Result<std::string>(const std::string& file)>;

class Detector : public Kernel {
 public:
  /// Settings of this implementation that stay for the mission, unlike the knob `detector.scale`.
  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const { return {}; }
  /// Once, before the first `detect`.
  ///
  /// @param chosen  Resolved from `parameters()`.
  /// @error         `not_found` for a file that is missing, `invalid_input` for one that is not
  ///                what it should be: the detector must not be used then.
  [[nodiscard]] virtual Status start(const Parameters& chosen, const FindModel& find_model) = 0;
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
