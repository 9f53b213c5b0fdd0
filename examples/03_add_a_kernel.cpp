// SPDX-License-Identifier: BSD-3-Clause
//
// Adds the kernel of kernels/blue_trousers.cpp to a program of one's own: any program that links
// flyball::apps can hand its own kernels, worlds and workloads to `fly`. This one checks the
// detector on painted pictures, by the contract of its family, and then follows a person with it.
//
// Without a program the same file flies as a library; README.md beside it has the command.

#include "flyball/kernels/conformance/detector_conformance.h"
#include "flyball/kernels/detector.h"
#include "flyball/scenario/plugins.h"
#include "flyball/simulation/mission.h"

#include <cstdio>

/// What FLYBALL_PLUGIN in kernels/blue_trousers.cpp defines.
extern "C" void flyball_plugin_blue_trousers(flyball::Registry& registry);

namespace {

using flyball::ColourImage;

/// A meadow of 80 x 60 pixels with blue trousers of 6 x 12 in it, whose upper edge is at `top`.
ColourImage painted(int top) {
  ColourImage image;
  image.camera.width_px = 80;
  image.camera.height_px = 60;
  for (int i = 0; i < 80 * 60; ++i) {
    const int u = i % 80;
    const int v = i / 80;
    const bool is_trousers = u >= 30 && u < 36 && v >= top && v < top + 12;
    const std::uint8_t meadow[] = {70, 110, 40};
    const std::uint8_t trousers[] = {40, 50, 90};
    image.rgb.insert(image.rgb.end(), is_trousers ? trousers : meadow,
                     (is_trousers ? trousers : meadow) + 3);
  }
  return image;
}

bool finds(const flyball::Plugins& plugins, int top, const flyball::ImageBox& person) {
  const auto detector = plugins.make<flyball::Detector>("blue_trousers");
  flyball::Work work;
  const auto found = detector->detect(painted(top), 1.0, work);
  return found && found->size() == 1 && flyball::overlap(found->front().box, person) > 0.99;
}

/// Somebody as a whole, and somebody whose head is above the picture.
bool finds_what_was_painted(const flyball::Plugins& plugins) {
  return finds(plugins, 40, {30.0, 28.0, 6.0, 24.0}) && finds(plugins, 4, {30.0, 0.0, 6.0, 16.0});
}

/// Every family has such checks, which need no test framework.
bool keeps_the_contract(const flyball::Plugins& plugins) {
  flyball::DetectorConformance conformance{
      {[&plugins] { return plugins.make<flyball::Detector>("blue_trousers"); }}};
  const auto breaches = conformance.breaches();
  for (const std::string& breach : breaches) {
    std::printf("blue_trousers %s\n", breach.c_str());
  }
  return breaches.empty();
}

/// Ten seconds of the shipped photography, priced as HOG: the modeled computer has no price for a
/// kernel that it has never seen.
flyball::Result<flyball::MissionRecord> follow_somebody(const flyball::Plugins& plugins) {
  auto loaded = flyball::load_scenario(
      "photography_park",
      {"detector.cost_of=hog", "photography.limit_s=10", "photography.success_s=8"}, plugins);
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
  const flyball::Plugins plugins = flyball::Plugins{}.with(flyball_plugin_blue_trousers);
  const bool is_sound = finds_what_was_painted(plugins) && keeps_the_contract(plugins);
  const auto flown = follow_somebody(plugins);
  if (!flown && flown.error().code == flyball::ErrorCode::not_found) {
    std::printf("not flown: %s\n", flown.error().message.c_str());  // No mesh of a person.
    return is_sound ? 0 : 1;
  }
  const bool follows = flown && flown->summary.status == flyball::MissionStatus::succeeded;
  if (flown) {
    std::printf("tracked for %.1f s, box off by %.1f %% of the image\n",
                flown->summary.quality.at("tracked_s"),
                flown->summary.quality.at("mean_centre_error_percent"));
  }
  std::puts(is_sound && follows ? "right" : "wrong");
  return is_sound && follows ? 0 : 1;
}
