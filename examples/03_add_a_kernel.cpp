// SPDX-License-Identifier: BSD-3-Clause
//
// Add a kernel in one file, outside of the tree: a detector that looks for blue trousers. Any
// program that links flyball::apps can hand its own kernels, worlds and workloads to `fly`; inside
// the tree the same class would go to kernels/perception/<name>.cpp, and nothing else is edited.
// This program checks the detector on a painted picture and then follows a person with it.

#include "flyball/kernels/detector.h"
#include "flyball/scenario/plugins.h"
#include "flyball/simulation/mission.h"

#include <algorithm>
#include <cstdio>

namespace {

using flyball::ColourImage;
using flyball::Detection;
using flyball::ImageBox;
using flyball::Work;

/// The widest run of rows in which something is clearly bluer than it is red or green. Trousers are
/// the lower half of a person.
class BlueTrousers final : public flyball::Detector {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"bluer_by", 15.0, 1.0, 200.0, "Grey levels that blue is above red and green."},
            {"least_px", 12.0, 1.0, 10000.0, "Fewer blue pixels are nobody."}};
  }

  flyball::Status start(const flyball::Parameters& chosen, const flyball::FindModel&) override {
    bluer_by_ = static_cast<int>(chosen.number("bluer_by"));
    least_px_ = chosen.number("least_px");
    return flyball::Done{};
  }

  flyball::Result<std::vector<Detection>> detect(const ColourImage& image,
                                                 double /*scale: every pixel is looked at*/,
                                                 Work& work) override {
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
    box.y_px = std::max(0.0, box.y_px - box.height_px);
    box.height_px *= 2.0;
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

namespace {

/// A meadow of 80 x 60 pixels with blue trousers of 6 x 12 in it.
ColourImage painted() {
  ColourImage image;
  image.camera.width_px = 80;
  image.camera.height_px = 60;
  for (int i = 0; i < 80 * 60; ++i) {
    const int u = i % 80;
    const int v = i / 80;
    const bool is_trousers = u >= 30 && u < 36 && v >= 40 && v < 52;
    const std::uint8_t meadow[] = {70, 110, 40};
    const std::uint8_t trousers[] = {40, 50, 90};
    image.rgb.insert(image.rgb.end(), is_trousers ? trousers : meadow,
                     (is_trousers ? trousers : meadow) + 3);
  }
  return image;
}

bool finds_what_was_painted() {
  Work work;
  const auto found = BlueTrousers{}.detect(painted(), 1.0, work);
  const ImageBox person{30.0, 28.0, 6.0, 24.0};
  return found && found->size() == 1 && flyball::overlap(found->front().box, person) > 0.99;
}

/// Ten seconds of the shipped photography, priced as HOG: the modeled computer has no price for a
/// kernel that it has never seen.
flyball::Result<flyball::MissionRecord> follow_somebody() {
  auto loaded = flyball::load_scenario(
      "photography_park",
      {"detector.cost_of=hog", "photography.limit_s=10", "photography.success_s=8"});
  if (const auto* errors = std::get_if<std::vector<flyball::Error>>(&loaded)) {
    return errors->front();
  }
  flyball::Scenario scenario = std::get<flyball::LoadedScenario>(loaded).scenario;
  scenario.kernels.detector = "blue_trousers";
  scenario.kernels.detector_parameters.clear();  // The scenario's are HOG's.
  return flyball::fly(scenario, {});
}

}  // namespace

int main() {
  flyball::add_plugins(flyball_plugin_blue_trousers);
  const bool finds = finds_what_was_painted();
  const auto flown = follow_somebody();
  if (!flown && flown.error().code == flyball::ErrorCode::not_found) {
    std::printf("not flown: %s\n", flown.error().message.c_str());  // No mesh of a person.
    return finds ? 0 : 1;
  }
  const bool follows = flown && flown->summary.status == flyball::MissionStatus::succeeded;
  if (flown) {
    std::printf("tracked for %.1f s, box off by %.1f %% of the image\n",
                flown->summary.quality.at("tracked_s"),
                flown->summary.quality.at("mean_centre_error_percent"));
  }
  std::puts(finds && follows ? "right" : "wrong");
  return finds && follows ? 0 : 1;
}
