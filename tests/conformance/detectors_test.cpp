// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/detector_conformance.h"
#include "flyball/runtime/gimbal.h"
#include "flyball/sim/colour_camera.h"

#include "kernel_trials.h"
#include "models.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Somebody before a wall, rendered from 4 m, in three poses; nobody on a machine without the
/// meshes.
std::vector<PicturedPerson> rendered_people() {
  std::vector<PicturedPerson> people;
  for (const double heading_rad : {0.4, 2.4, 4.5}) {
    World world;
    world.bounds_W = {{-20.0, -20.0, 0.0}, {20.0, 20.0, 20.0}};
    world.ground_material = Material::gravel;
    world.boxes = {{{4.0, -9.0, 0.0}, {4.5, 9.0, 5.0}}};
    Person person;
    person.walk = {{0.0, Vec3::Zero()}};
    person.heading_rad = heading_rad;
    world.people = {person};
    const auto camera = ColourCamera::make(world, {});
    if (!camera) {
      GTEST_LOG_(INFO) << camera.error().message;
      return {};
    }
    Pose X_WC = camera_in_level_frame({0.0, 0.0});
    X_WC.translation() = Vec3{-4.0, 0.0, 0.875};
    PicturedPerson pictured;
    pictured.image = (*camera)->capture(X_WC, MissionTime{}, 0);
    pictured.box = *box_of(person, MissionTime{}, X_WC, pictured.image.camera);
    pictured.scale = 1.5;
    people.push_back(std::move(pictured));
  }
  return people;
}

TEST(Detectors, keep_their_contract) {
  kit::try_all_registered<DetectorConformance, Detector>(find_test_model);
}

TEST(Detectors, keep_their_contract_behind_a_knob_that_chooses_among_them) {
  kit::try_all_behind_a_switch<DetectorConformance, Detector, SwitchedDetector>(
      [](Detector& detector) {
        Work work;
        (void)detector.detect({}, 1.0, work);
      },
      find_test_model);
}

// Not haar: its cascades find next to none of the people that this simulator renders.
TEST(Detectors, find_people_that_are_shown_to_them) {
  const auto people = rendered_people();
  for (const char* name : {"hog", "yolo"}) {
    DetectorConformance conformance{
        {[name] { return kit::kernels().make<Detector>(name); }, {}, find_test_model}, people};
    for (const std::string& breach : conformance.breaches()) {
      EXPECT_EQ(breach.rfind("cannot be configured: ", 0), 0U) << name << " " << breach;
    }
  }
}

/// Finds the reddest rectangle; or breaks a rule.
class DetectorCulprit final : public Detector {
 public:
  explicit DetectorCulprit(std::string crime) : crime_{std::move(crime)} {}

  Result<std::vector<Detection>> detect(const ColourImage& image,
                                        double scale,
                                        Work& work) override {
    const bool is_sound =
        image.camera.width_px > 0 &&
        image.rgb.size() ==
            3UL * static_cast<std::size_t>(image.camera.width_px * image.camera.height_px);
    if (!is_sound && crime_ != "credulous") {
      return Error{ErrorCode::invalid_input, "no image"};
    }
    if (!(scale > 0.0 && scale <= 8.0) && crime_ != "any_scale") {
      return Error{ErrorCode::invalid_input, "no scale"};
    }
    count(image, scale, work);
    return spoilt(red(is_sound ? image : ColourImage{}));
  }

 private:
  void count(const ColourImage& image, double scale, Work& work) const {
    const double pixels = image.camera.width_px * image.camera.height_px * scale * scale;
    work.add("images", crime_ == "idle" ? 0.0 : 1.0);
    work.add("pixels", crime_ == "shrinking" ? 1e6 / pixels : pixels);
  }
  static std::vector<Detection> red(const ColourImage& image) {
    ImageBox box{1e9, 1e9, 0.0, 0.0};
    double right_px = 0.0;
    double lowest_px = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < image.rgb.size() / 3; ++i) {
      if (image.rgb[3 * i] > image.rgb[3 * i + 1] + 50) {
        const int u = static_cast<int>(i) % image.camera.width_px;
        const int v = static_cast<int>(i) / image.camera.width_px;
        box = {std::min(box.x_px, 1.0 * u), std::min(box.y_px, 1.0 * v), 0.0, 0.0};
        right_px = std::max(right_px, u + 1.0);
        lowest_px = std::max(lowest_px, v + 1.0);
        count += 1.0;
      }
    }
    box.width_px = right_px - box.x_px;
    box.height_px = lowest_px - box.y_px;
    return count > 0.0 ? std::vector<Detection>{{box, count}} : std::vector<Detection>{};
  }
  std::vector<Detection> spoilt(std::vector<Detection> found) {
    if (crime_ == "sees_ghosts") {
      found.push_back({{1, 1, 4, 4}, 0.1});
    } else if (crime_ == "blind") {
      found.clear();
    } else if (!found.empty()) {
      if (crime_ == "flat") {
        found[0].box.height_px = 0.0;
      } else if (crime_ == "outside") {
        found[0].box.x_px = -500.0;
      } else if (crime_ == "unsorted") {
        found.push_back({found[0].box, found[0].score + 1.0});
      } else if (crime_ == "remembers") {
        found[0].score += shown_++;
      }
    }
    return found;
  }

  std::string crime_;
  double shown_{};
};

class TriedOnRed : public DetectorConformance {
 public:
  explicit TriedOnRed(KernelCandidate<Detector> candidate)
      : DetectorConformance{std::move(candidate), {person(), person()}} {}

 private:
  static PicturedPerson person() {
    PicturedPerson person;
    person.image.camera = {64, 64, 60.0, 32.0, 32.0};
    person.image.rgb.assign(3UL * 64 * 64, 90);
    person.box = {20.0, 10.0, 12.0, 40.0};
    for (std::size_t i = 0; i < 64UL * 64; ++i) {
      const std::size_t u = i % 64;
      const std::size_t v = i / 64;
      if (u >= 20 && u < 32 && v >= 10 && v < 50) {
        person.image.rgb[3 * i] = 200;
      }
    }
    return person;
  }
};

TEST(DetectorConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<TriedOnRed, Detector>(
      [](const std::string& crime) { return std::make_unique<DetectorCulprit>(crime); },
      {{"credulous", "accepts an image that is empty"},
       {"any_scale", "accepts a scale that is not in (0, 8]"},
       {"idle", "does not count its images"},
       {"shrinking", "counts less work for a larger input"},
       {"sees_ghosts", "finds somebody in a plain picture"},
       {"blind", "finds none of the people"},
       {"flat", "finds a box without extent"},
       {"outside", "finds somebody outside of the image"},
       {"unsorted", "does not put the surest first"},
       {"remembers", "finds others after other pictures"}});
}

}  // namespace
}  // namespace flyball
