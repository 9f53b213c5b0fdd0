// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/colour_frame.h"

#include <thread>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr int width_px = 37;  // No multiple of anything.
constexpr int height_px = 22;

std::uint8_t shade(int x, int y) {
  return static_cast<std::uint8_t>(7 * x + 31 * y);
}

/// Renders `shade`, and counts how often each pixel was rendered.
class CountedPicture : public testing::Test {
 protected:
  void render(const std::vector<PixelRegion>& regions, ColourImage& into) {
    ++calls;
    for (const PixelRegion& region : regions) {
      ASSERT_TRUE(whole(camera).covers(region));
      for (int y = region.y_px; y < region.y_px + region.height_px; ++y) {
        for (int x = region.x_px; x < region.x_px + region.width_px; ++x) {
          const auto i = static_cast<std::size_t>(y * width_px + x);
          ++rendered[i];
          std::fill_n(into.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, shade(x, y));
        }
      }
    }
  }
  [[nodiscard]] int pixels() const {
    return static_cast<int>(rendered.size()) -
           static_cast<int>(std::count(rendered.begin(), rendered.end(), 0));
  }

  Intrinsics camera{width_px, height_px, 30.0, 18.0, 10.5};
  int calls{};
  std::vector<int> rendered = std::vector<int>(std::size_t{width_px} * height_px);
  DeferredImage picture{{MissionTime{}, 5, camera, {}},
                        [this](const std::vector<PixelRegion>& regions, ColourImage& into) {
                          render(regions, into);
                        }};
};

TEST_F(CountedPicture, renders_nothing_before_somebody_looks) {
  const DeferredImage copy = picture;  // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_TRUE(copy.part({}).rgb.empty());
  EXPECT_EQ(calls, 0);
}

TEST_F(CountedPicture, shows_the_part_that_was_asked_for_and_renders_little_more) {
  const PixelRegion region{17, 9, 6, 5};
  const ColourPatch patch = picture.part(region);
  ASSERT_EQ(patch.rgb.size(), 3U * 6U * 5U);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      EXPECT_EQ(patch.rgb[3 * static_cast<std::size_t>(6 * y + x)], shade(17 + x, 9 + y));
    }
  }
  EXPECT_GE(pixels(), 6 * 5);
  EXPECT_LE(pixels(), 16 * 16) << "to the next multiples of 8";
}

TEST_F(CountedPicture, renders_no_pixel_twice) {
  (void)picture.part({3, 2, 10, 6});
  (void)picture.part({8, 0, 29, 20});
  const DeferredImage copy = picture;
  const ColourImage& all = copy.value();
  EXPECT_EQ(rendered, std::vector<int>(rendered.size(), 1));
  EXPECT_EQ(all.sequence, 5U);
  for (int i = 0; i < width_px * height_px; ++i) {
    ASSERT_EQ(all.rgb[3 * static_cast<std::size_t>(i)], shade(i % width_px, i / width_px));
  }
  const int before = calls;
  EXPECT_EQ(&picture.value(), &all);
  (void)picture.part({0, 0, width_px, height_px});
  EXPECT_EQ(calls, before);
}

TEST_F(CountedPicture, renders_no_pixel_twice_for_many_threads) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([this, i] { (void)picture.part({4 * i, i, 20, 18}); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  (void)picture.value();
  EXPECT_EQ(rendered, std::vector<int>(rendered.size(), 1));
}

TEST(DeferredImage, holds_a_picture_that_exists_already) {
  ColourImage image;
  image.camera = {2, 1, 1.0, 0.5, 0.0};
  image.rgb = {1, 2, 3, 4, 5, 6};
  const DeferredImage picture = DeferredImage::of(image);
  EXPECT_EQ(picture.value().rgb, image.rgb);
  EXPECT_EQ(picture.part({1, 0, 1, 1}).rgb, (std::vector<std::uint8_t>{4, 5, 6}));
  EXPECT_TRUE(DeferredImage{}.value().rgb.empty());
}

TEST(DeferredImageDeathTest, refuses_a_part_that_is_not_in_the_picture) {
  ColourImage image;
  image.camera = {2, 1, 1.0, 0.5, 0.0};
  image.rgb.resize(6);
  EXPECT_DEATH((void)DeferredImage::of(image).part({1, 0, 2, 1}), "2 x 1 pixels");
}

}  // namespace
}  // namespace flyball
