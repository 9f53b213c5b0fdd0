// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/tracker.h"

#include "flyball/kernels/kernels.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr int width_px = 120;
constexpr int height_px = 90;

/// A checked square of 24 pixels, or as many times that, on faint noise, its upper left corner at
/// (x, y).
ColourImage image_with_square(int x, int y, int times = 1) {
  ColourImage image;
  image.camera = {times * width_px, times * height_px, 100.0, 0.0, 0.0};
  RandomStream noise{1, "tracker"};
  for (int row = 0; row < image.camera.height_px; ++row) {
    for (int column = 0; column < image.camera.width_px; ++column) {
      const int u = column - x;
      const int v = row - y;
      const bool inside = u >= 0 && v >= 0 && u < 24 * times && v < 24 * times;
      const auto grey = static_cast<std::uint8_t>(100 + noise.next() % 8);
      const bool dark = ((u / (6 * times)) + (v / (8 * times))) % 2 == 0;
      image.rgb.push_back(inside ? (dark ? 20 : 230) : grey);
      image.rgb.push_back(inside ? (dark ? 20 : 60) : grey);
      image.rgb.push_back(grey);
    }
  }
  return image;
}

ColourPatch all_of(const ColourImage& image) {
  return cut(image, whole(image.camera));
}

ColourPatch square_at(int x, int y) {
  return all_of(image_with_square(x, y));
}

class Kcf : public testing::Test {
 protected:
  void SetUp() override {
    Registry registry;
    register_kernels(registry);
    tracker = registry.make<Tracker>("kcf");
    ASSERT_NE(tracker, nullptr);
    const auto chosen = Parameters::resolve("kcf", tracker->parameters(), {});
    EXPECT_TRUE(tracker->configure(std::get<Parameters>(chosen), no_models));
  }

  /// What it says to a square that moves, shown what it asks for, or everything.
  std::vector<std::optional<ImageBox>> follow(bool shows_all,
                                              int times,
                                              const Eigen::Vector2i& step) {
    const auto show = [&](const ColourImage& image, const PixelRegion& region) {
      return shows_all ? all_of(image) : cut(image, region);
    };
    const double size_px = 24.0 * times;
    const ImageBox start{30.0 * times, 30.0 * times, size_px, size_px};
    const ColourImage first = image_with_square(30 * times, 30 * times, times);
    EXPECT_TRUE(
        tracker->begin(show(first, tracker->learns_from(start, first.camera)), start, work).ok());
    std::vector<std::optional<ImageBox>> boxes;
    for (int i = 1; i <= 7; ++i) {
      const ColourImage next =
          image_with_square(30 * times + i * step.x(), 30 * times + i * step.y(), times);
      const auto box = tracker->update(show(next, tracker->looks_at(next.camera)), work);
      EXPECT_TRUE(box.ok());
      boxes.push_back(*box);
    }
    return boxes;
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
  EXPECT_FALSE(tracker->update(all_of(small), work).ok());
}

bool same(const std::optional<ImageBox>& a, const std::optional<ImageBox>& b) {
  if (!a || !b) {
    return a.has_value() == b.has_value();
  }
  return a->x_px == b->x_px && a->y_px == b->y_px && a->width_px == b->width_px &&
         a->height_px == b->height_px;
}

TEST_F(Kcf, says_the_same_whether_it_sees_all_or_what_it_asks_for) {
  // Small steps, steps that it cannot follow, and out of the image; a box that it halves, too.
  for (const int times : {1, 4}) {
    for (const Eigen::Vector2i& step : {Eigen::Vector2i{2, 1}, Eigen::Vector2i{11, -7},
                                        Eigen::Vector2i{-9, 2}, Eigen::Vector2i{25, 20}}) {
      const auto all = follow(true, times, times * step);
      const auto part = follow(false, times, times * step);
      ASSERT_EQ(all.size(), part.size());
      for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_TRUE(same(all[i], part[i])) << times << " x " << step.transpose() << ", " << i;
      }
    }
  }
}

TEST_F(Kcf, asks_for_a_part_of_a_large_image) {
  const Intrinsics camera = image_with_square(0, 0, 4).camera;
  EXPECT_TRUE(tracker->looks_at(camera).is_empty()) << "it follows nothing yet";
  const ImageBox box{200, 150, 24, 40};
  ASSERT_TRUE(tracker->begin(all_of(image_with_square(200, 150, 4)), box, work).ok());
  const PixelRegion region = tracker->looks_at(camera);
  EXPECT_TRUE(region.covers({164, 90, 96, 160}));
  EXPECT_LT(region.width_px * region.height_px, camera.width_px * camera.height_px / 5);
}

TEST_F(Kcf, refuses_a_patch_without_the_pixels_that_it_reads) {
  const ColourImage image = image_with_square(30, 30);
  const ImageBox box{30, 30, 24, 24};
  EXPECT_FALSE(tracker->begin(cut(image, {30, 30, 24, 24}), box, work).ok());
  ASSERT_TRUE(tracker->begin(all_of(image), box, work).ok());
  const auto answer = tracker->update(cut(image, {20, 20, 40, 40}), work);
  ASSERT_FALSE(answer.ok());
  EXPECT_NE(answer.error().message.find("looks_at"), std::string::npos);
  EXPECT_TRUE(tracker->update(all_of(image), work)->has_value()) << "it goes on";
}

}  // namespace
}  // namespace flyball
