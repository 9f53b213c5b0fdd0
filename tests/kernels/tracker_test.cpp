// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/tracker.h"

#include "flyball/kernels/kernels.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"

#include <memory>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr int width_px = 120;
constexpr int height_px = 90;

/// A checked square of 24 pixels on faint noise, its upper left corner at (x, y).
ColourImage square_at(int x, int y) {
  ColourImage image;
  image.camera = {width_px, height_px, 100.0, 0.0, 0.0};
  RandomStream noise{1, "tracker"};
  for (int row = 0; row < height_px; ++row) {
    for (int column = 0; column < width_px; ++column) {
      const int u = column - x;
      const int v = row - y;
      const bool inside = u >= 0 && v >= 0 && u < 24 && v < 24;
      const auto grey = static_cast<std::uint8_t>(100 + noise.next() % 8);
      const bool dark = ((u / 6) + (v / 8)) % 2 == 0;
      image.rgb.push_back(inside ? (dark ? 20 : 230) : grey);
      image.rgb.push_back(inside ? (dark ? 20 : 60) : grey);
      image.rgb.push_back(grey);
    }
  }
  return image;
}

class Kcf : public testing::Test {
 protected:
  void SetUp() override {
    Registry registry;
    register_kernels(registry);
    tracker = registry.make<Tracker>("kcf");
    ASSERT_NE(tracker, nullptr);
    const auto chosen = Parameters::resolve("kcf", tracker->parameters(), {});
    tracker->configure(std::get<Parameters>(chosen));
  }
  std::unique_ptr<Tracker> tracker;
  Work work{};
};

TEST_F(Kcf, follows_what_moves) {
  ASSERT_TRUE(tracker->begin(square_at(30, 30), {30, 30, 24, 24}, work).ok());
  for (int step = 1; step <= 8; ++step) {
    const auto box = tracker->update(square_at(30 + 4 * step, 30 + step), work);
    ASSERT_TRUE(box.ok());
    ASSERT_TRUE(box->has_value()) << "step " << step;
    EXPECT_NEAR((*box)->x_px, 30 + 4 * step, 2.0);
    EXPECT_NEAR((*box)->y_px, 30 + step, 2.0);
  }
  EXPECT_EQ(work.count("starts"), 1.0);
  EXPECT_EQ(work.count("updates"), 8.0);
}

TEST_F(Kcf, says_so_when_it_is_gone) {
  ASSERT_TRUE(tracker->begin(square_at(30, 30), {30, 30, 24, 24}, work).ok());
  const auto box = tracker->update(square_at(-50, -50), work);
  ASSERT_TRUE(box.ok());
  EXPECT_FALSE(box->has_value());
}

TEST_F(Kcf, does_the_same_again) {
  const auto last_box = [this] {
    EXPECT_TRUE(tracker->begin(square_at(30, 30), {30, 30, 24, 24}, work).ok());
    ImageBox last;
    for (int step = 1; step <= 4; ++step) {
      last = (*tracker->update(square_at(30 + 3 * step, 30), work)).value_or(ImageBox{});
    }
    return last;
  };
  const ImageBox first = last_box();
  const ImageBox second = last_box();
  EXPECT_EQ(first.x_px, second.x_px);
  EXPECT_EQ(first.y_px, second.y_px);
}

TEST_F(Kcf, follows_nothing_before_it_began_and_after_it_could_not) {
  EXPECT_FALSE((*tracker->update(square_at(30, 30), work)).has_value());
  EXPECT_FALSE(tracker->begin(square_at(30, 30), {119, 89, 24, 24}, work).ok());
  EXPECT_FALSE((*tracker->update(square_at(30, 30), work)).has_value());
  EXPECT_EQ(work.count("updates"), 0.0);
}

TEST_F(Kcf, refuses_an_image_of_another_size) {
  ASSERT_TRUE(tracker->begin(square_at(30, 30), {30, 30, 24, 24}, work).ok());
  ColourImage small;
  small.camera = {8, 8, 10.0, 0.0, 0.0};
  small.rgb.resize(3 * 8 * 8);
  EXPECT_FALSE(tracker->update(small, work).ok());
}

}  // namespace
}  // namespace flyball
