// SPDX-License-Identifier: BSD-3-Clause
// tested-in: frame_files
#include "flyball/flight/mission_frame.h"

#include <utility>

namespace flyball {

MissionFrame boxed(ColourImage image, const ImageBox& box, bool is_right, std::string caption) {
  constexpr Rgb right{40, 220, 40};
  constexpr Rgb wrong{255, 40, 40};
  draw_box(image, box, is_right ? right : wrong);
  return {std::move(caption), std::move(image)};
}

}  // namespace flyball
