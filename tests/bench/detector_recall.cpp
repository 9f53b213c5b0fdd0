// SPDX-License-Identifier: BSD-3-Clause
//
// How often each detector finds the rendered person, by distance and angle, and how often it finds
// one where there is none. Prints Markdown. Weights are taken from $FLYBALL_MODELS.
//
//   ninja detector_recall && FLYBALL_MODELS=DIR bin/detector_recall

#include "flyball/kernels/detector.h"
#include "flyball/sim/colour_camera.h"

#include "scenario/kernel_choice.h"
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace flyball {
namespace {

constexpr double degree_rad = 3.14159265358979323846 / 180.0;
constexpr std::array<double, 6> distances_m{4.0, 6.0, 8.0, 10.0, 12.0, 15.0};
constexpr std::array<double, 4> downs_deg{0.0, 15.0, 30.0, 45.0};
constexpr std::array<double, 3> headings_deg{20.0, 140.0, 260.0};
constexpr std::array<Material, 3> grounds{Material::grass, Material::gravel, Material::asphalt};
constexpr double least_overlap = 0.25;  // With the upright cylinder around the person.

struct Subject {
  std::string title;
  std::string kind;
  std::map<std::string, ParameterValue> parameters;
  double scale;
  std::unique_ptr<Detector> detector{};
  std::array<std::array<int, downs_deg.size()>, distances_m.size()> found{};
  int false_boxes_on_people{};  ///< Beside the person.
  int false_boxes{};            ///< In images without one.
};

std::vector<Subject> subjects() {
  using Given = std::map<std::string, ParameterValue>;
  std::vector<Subject> all;
  all.push_back({"hog, scale 1.5", "hog", Given{}, 1.5});
  all.push_back({"hog, scale 2", "hog", Given{}, 2.0});
  all.push_back({"hog, scale 2, as in photography_park", "hog",
                 Given{{"level_step", 1.1}, {"threshold", -0.2}}, 2.0});
  all.push_back({"haar, scale 1.5", "haar", Given{}, 1.5});
  all.push_back({"yolo (yolo-fastest-1.1), scale 1", "yolo", Given{}, 1.0});
  all.push_back({"yolo (yolo-fastest-1.1-xl), scale 1", "yolo",
                 Given{{"model", std::string{"yolo-fastest-1.1-xl"}}}, 1.0});
  return all;
}

/// A clearing: trees, a bench, a hedge and a wall behind the place of the person.
World clearing(Material ground) {
  World world;
  world.bounds_W = {{-40.0, -40.0, 0.0}, {40.0, 40.0, 20.0}};
  world.ground_material = ground;
  for (const auto& [x, y] :
       {std::pair{4.0, 3.0}, {6.0, -4.0}, {9.0, 1.5}, {2.5, -5.0}, {12.0, 6.0}}) {
    world.pillars.push_back({{x, y, 0.0}, 0.1, 1.5, Material::bark});
    world.pillars.push_back({{x, y, 1.5}, 0.9, 1.4, Material::leaves});
  }
  world.boxes = {{{3.0, -2.5, 0.0}, {3.5, -0.7, 0.45}},
                 {{5.0, 0.5, 0.0}, {5.6, 4.5, 1.2}},
                 {{15.0, -12.0, 0.0}, {15.5, 2.0, 3.0}}};
  world.box_materials = {Material::wood, Material::leaves, Material::brick};
  return world;
}

/// Looks at the middle of a person at the origin, from the west.
Pose view(double distance_m, double down_rad) {
  Pose X_WC = camera_in_level_frame({0.0, down_rad});
  X_WC.translation() =
      Vec3{-distance_m * std::cos(down_rad), 0.0, 0.875 + distance_m * std::sin(down_rad)};
  return X_WC;
}

std::vector<Detection> look(Subject& subject, const ColourImage& image) {
  Work work;
  const auto people = subject.detector->detect(image, subject.scale, work);
  return people ? *people : std::vector<Detection>{};
}

void with_person(std::vector<Subject>& all, Material ground) {
  for (const double heading_deg : headings_deg) {
    World world = clearing(ground);
    Person person;
    person.walk = {{0.0, Vec3::Zero()}};
    person.heading_rad = heading_deg * degree_rad;
    world.people = {person};
    const auto camera = ColourCamera::make(world, {});
    if (!camera) {
      std::fprintf(stderr, "%s\n", camera.error().message.c_str());
      std::exit(2);
    }
    for (std::size_t i = 0; i < distances_m.size() * downs_deg.size(); ++i) {
      const std::size_t d = i / downs_deg.size();
      const std::size_t a = i % downs_deg.size();
      const Pose X_WC = view(distances_m[d], downs_deg[a] * degree_rad);
      const ColourImage image = (*camera)->capture(X_WC, MissionTime{}, 0);
      const auto truth = box_of(person, MissionTime{}, X_WC, image.camera);
      for (Subject& subject : all) {
        bool hit = false;
        for (const Detection& box : look(subject, image)) {
          const bool here = overlap(box.box, *truth) >= least_overlap;
          subject.false_boxes_on_people += here ? 0 : 1;
          hit = hit || here;
        }
        subject.found[d][a] += hit ? 1 : 0;
      }
    }
  }
}

int without_person(std::vector<Subject>& all, Material ground) {
  const auto camera = ColourCamera::make(clearing(ground), {});
  int images = 0;
  for (const double distance_m : distances_m) {
    for (const double down_deg : downs_deg) {
      const ColourImage image =
          (*camera)->capture(view(distance_m, down_deg * degree_rad), MissionTime{}, 0);
      ++images;
      for (Subject& subject : all) {
        subject.false_boxes += static_cast<int>(look(subject, image).size());
      }
    }
  }
  return images;
}

void print_table(const Subject& subject, int empty_images) {
  const int per_cell = static_cast<int>(headings_deg.size() * grounds.size());
  int sum = 0;
  std::printf("\n### %s\n\n| distance m |", subject.title.c_str());
  for (const double down_deg : downs_deg) {
    std::printf(" %.0f deg down |", down_deg);
  }
  std::printf("\n|---|---|---|---|---|\n");
  for (std::size_t d = 0; d < distances_m.size(); ++d) {
    std::printf("| %.0f |", distances_m[d]);
    for (const int found : subject.found[d]) {
      sum += found;
      std::printf(" %d / %d |", found, per_cell);
    }
    std::printf("\n");
  }
  const int views = per_cell * static_cast<int>(distances_m.size() * downs_deg.size());
  std::printf(
      "\nRecall %d / %d = %.0f %%; false boxes: %.2f per image with a person, %.2f per image "
      "without (%d images).\n",
      sum, views, 100.0 * sum / views, 1.0 * subject.false_boxes_on_people / views,
      1.0 * subject.false_boxes / empty_images, empty_images);
}

int measure() {
  std::vector<Subject> present;
  for (Subject& subject : subjects()) {
    Scenario scenario;
    scenario.kernels.detector = subject.kind;
    scenario.kernels.detector_parameters = subject.parameters;
    auto detector =
        make_kernel<Detector>(scenario.plugins, scenario.kernels, model_finder(scenario));
    if (!detector) {
      std::printf("%s is left out: %s\n", subject.title.c_str(), detector.error().message.c_str());
      continue;
    }
    subject.detector = std::move(*detector);
    present.push_back(std::move(subject));
  }
  int empty_images = 0;
  for (const Material ground : grounds) {
    with_person(present, ground);
    empty_images += without_person(present, ground);
  }
  std::printf("## Recall of the rendered person (384 x 288 pixels, 65 degrees)\n");
  for (const Subject& subject : present) {
    print_table(subject, empty_images);
  }
  return 0;
}

}  // namespace
}  // namespace flyball

int main() {
  return flyball::measure();
}
