// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/detector.h"

#include "flyball/kernels/kernels.h"
#include "flyball/runtime/registry.h"

#include "models.h"
#include <memory>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::unique_ptr<Detector> make(const std::string& name) {
  Registry registry;
  register_kernels(registry);
  return registry.make<Detector>(name);
}

Status start(Detector& detector, const std::map<std::string, ParameterValue>& given = {}) {
  const auto chosen = Parameters::resolve("detector", detector.parameters(), given);
  return detector.configure(std::get<Parameters>(chosen), find_test_model);
}

/// Grey, darker towards the bottom: nobody is in it.
ColourImage empty_scene(int width_px, int height_px) {
  ColourImage image;
  image.camera = {width_px, height_px, 200.0, 0.0, 0.0};
  for (int row = 0; row < height_px; ++row) {
    image.rgb.insert(image.rgb.end(), static_cast<std::size_t>(3 * width_px),
                     static_cast<std::uint8_t>(200 - row / 4));
  }
  return image;
}

class EveryDetector : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    detector = make(GetParam());
    ASSERT_NE(detector, nullptr);
    const Status started = start(*detector);
    if (!started && started.error().code == ErrorCode::not_found) {
      GTEST_SKIP() << "no weights of the network";
    }
    ASSERT_TRUE(started.ok()) << started.error().message;
  }
  std::unique_ptr<Detector> detector;
};

TEST_P(EveryDetector, refuses_what_is_no_image_and_a_scale_that_is_none) {
  Work work;
  EXPECT_FALSE(detector->detect(ColourImage{}, 1.0, work).ok());
  EXPECT_FALSE(detector->detect(empty_scene(160, 160), 0.0, work).ok());
}

TEST_P(EveryDetector, finds_nobody_where_nobody_is_and_says_what_that_took) {
  Work work;
  const auto found = detector->detect(empty_scene(160, 160), 1.0, work);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_TRUE(found->empty());
  EXPECT_GT(work.count("pixels"), 0.0);
  EXPECT_GT(work.count("windows") + work.count("multiply_adds"), 0.0);
}

TEST_P(EveryDetector, works_less_on_a_smaller_image) {
  Work full;
  Work half;
  ASSERT_TRUE(detector->detect(empty_scene(192, 192), 1.0, full).ok());
  ASSERT_TRUE(detector->detect(empty_scene(192, 192), 0.75, half).ok());
  EXPECT_LT(half.count("pixels"), full.count("pixels"));
  EXPECT_LT(half.count("windows") + half.count("multiply_adds"),
            full.count("windows") + full.count("multiply_adds"));
}

TEST_P(EveryDetector, finds_nobody_in_an_image_smaller_than_its_window) {
  Work work;
  const auto found = detector->detect(empty_scene(8, 8), 1.0, work);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_TRUE(found->empty());
}

INSTANTIATE_TEST_SUITE_P(All, EveryDetector, testing::Values("hog", "haar", "yolo"));

TEST(Haar, says_which_package_brings_its_cascades) {
  const auto haar = make("haar");
  const Status started = start(*haar, {{"folder", std::string{"/nowhere"}}});
  ASSERT_FALSE(started.ok());
  EXPECT_EQ(started.error().code, ErrorCode::not_found);
  EXPECT_NE(started.error().message.find("opencv-data"), std::string::npos);
}

TEST(Yolo, counts_the_multiply_adds_that_its_authors_state) {
  const auto yolo = make("yolo");
  if (!start(*yolo).ok()) {
    GTEST_SKIP() << "no weights of the network";
  }
  Work work;
  ASSERT_TRUE(yolo->detect(empty_scene(320, 320), 1.0, work).ok());
  // Yolo-Fastest 1.1: 0.252 BFLOPs at 320 x 320, two operations to a multiply-add.
  EXPECT_NEAR(work.count("multiply_adds"), 0.126e9, 0.004e9);
}

}  // namespace
}  // namespace flyball
