// SPDX-License-Identifier: BSD-3-Clause
//
// A kernel in one file, outside of the tree: a detector that looks for blue trousers. Inside the
// tree the same file would go to kernels/perception/, and nothing else is edited. Here it is
// compiled into a program (03_add_a_kernel.cpp), and as a library that `flyball run --kernels`
// loads. The library's name is the kernel's, as FLYBALL_PLUGIN has it: libblue_trousers.so.

#include "flyball/kernels/detector.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <string>

namespace {

using flyball::ColourImage;
using flyball::Detection;
using flyball::ImageBox;
using flyball::Work;

/// Takes all that is clearly bluer than it is red or green for one pair of trousers, and those for
/// the lower half of a person.
class BlueTrousers final : public flyball::Detector {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"bluer_by", 15.0, 1.0, 200.0, "Grey levels that blue is above red and green."},
            {"least_px", 12.0, 1.0, 10000.0, "Fewer blue pixels are nobody."}};
  }

  flyball::Status configure(const flyball::Parameters& chosen, const flyball::FindModel&) override {
    bluer_by_ = static_cast<int>(chosen.number("bluer_by"));
    least_px_ = chosen.number("least_px");
    return flyball::Done{};
  }

  /// A policy may turn the threshold in flight; it begins with the parameter's value.
  [[nodiscard]] std::vector<flyball::KnobSpec> knobs() const override {
    auto all = Detector::knobs();
    all.push_back({"blue_trousers.bluer_by",
                   "grey levels",
                   "detect",
                   {},
                   1.0,
                   200.0,
                   1.0 * bluer_by_,
                   "that blue is above red and green"});
    return all;
  }
  void apply(const flyball::KnobSettings& knobs) override {
    bluer_by_ = static_cast<int>(knobs.value("blue_trousers.bluer_by"));
  }

  flyball::Result<std::vector<Detection>> detect(const ColourImage& image,
                                                 double scale,  // Every pixel is looked at.
                                                 Work& work) override {
    if (!(scale > 0.0 && scale <= 8.0)) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "scale " + std::to_string(scale) + " must be above 0 and at most 8"};
    }
    const int width = image.camera.width_px;
    const int height = image.camera.height_px;
    if (width <= 0 || image.rgb.size() != 3UL * width * height) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "the image is empty or not of its camera's size"};
    }
    work.add("images", 1.0);
    work.add("pixels", static_cast<double>(width) * height);
    ImageBox box;
    double count = 0.0;
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        if (is_blue(&image.rgb[3UL * (static_cast<std::size_t>(v) * width + u)])) {
          box = count > 0.0 ? around(box, u, v) : ImageBox{1.0 * u, 1.0 * v, 1.0, 1.0};
          count += 1.0;
        }
      }
    }
    if (count < least_px_ || box.height_px < box.width_px) {
      return std::vector<Detection>{};
    }
    const double feet_px = box.y_px + box.height_px;
    box.y_px = std::max(0.0, box.y_px - box.height_px);
    box.height_px = feet_px - box.y_px;  // Less than twice the trousers where the head is cut off.
    return std::vector<Detection>{{box, count}};
  }

 private:
  [[nodiscard]] bool is_blue(const std::uint8_t* rgb) const {
    return rgb[2] >= rgb[0] + bluer_by_ && rgb[2] >= rgb[1] + bluer_by_;
  }

  static ImageBox around(const ImageBox& box, int u, int v) {
    const double left = std::min(box.x_px, 1.0 * u);
    const double right = std::max(box.x_px + box.width_px, u + 1.0);
    return {left, box.y_px, right - left, v + 1.0 - box.y_px};
  }

  int bluer_by_{15};
  double least_px_{12.0};
};

}  // namespace

FLYBALL_PLUGIN(blue_trousers) {
  registry.add<flyball::Detector>("blue_trousers", [] { return std::make_unique<BlueTrousers>(); });
}
