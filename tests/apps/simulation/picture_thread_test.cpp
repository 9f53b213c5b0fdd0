// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/picture_thread.h"

#include <chrono>
#include <cstdint>
#include <future>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// A picture of one pixel that is drawn when `may_draw` says so, on a thread that `drawn_by` tells.
struct Drawing {
  std::promise<void> may_draw{};
  std::promise<std::thread::id> drawn_by{};

  ColourFrame frame(std::uint64_t sequence) {
    ColourImage blank;
    blank.camera = {1, 1, 1.0, 0.5, 0.5};
    blank.rgb.resize(3);
    ColourFrame frame;
    frame.sequence = sequence;
    frame.camera = blank.camera;
    frame.image = DeferredImage{blank, [this](const std::vector<PixelRegion>&, ColourImage& into) {
                                  drawn_by.set_value(std::this_thread::get_id());
                                  may_draw.get_future().wait();
                                  into.rgb = {1, 2, 3};
                                }};
    return frame;
  }
};

std::vector<TakenPicture> await_ready(PictureThread& thread) {
  for (;;) {
    auto ready = thread.take_ready();
    if (!ready.empty()) {
      return ready;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds{1});
  }
}

TEST(PictureThread, draws_beside_its_caller) {
  Drawing drawing;
  PictureThread thread;
  thread.draw({drawing.frame(7), {}});
  EXPECT_NE(drawing.drawn_by.get_future().get(), std::this_thread::get_id());
  EXPECT_TRUE(thread.take_ready().empty());  // It is being drawn, and nobody waited for it.
  drawing.may_draw.set_value();
  const auto ready = await_ready(thread);
  ASSERT_EQ(ready.size(), 1U);
  EXPECT_EQ(ready.front().colour.sequence, 7U);
  EXPECT_EQ(ready.front().colour.image.value().rgb, (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_TRUE(thread.take_ready().empty());
}

TEST(PictureThread, leaves_out_a_picture_that_it_could_not_begin_before_the_next) {
  Drawing first;
  Drawing second;
  Drawing third;
  PictureThread thread;
  thread.draw({first.frame(1), {}});
  (void)first.drawn_by.get_future().get();  // Begun.
  thread.draw({second.frame(2), {}});
  thread.draw({third.frame(3), {}});
  third.may_draw.set_value();
  first.may_draw.set_value();
  std::vector<std::uint64_t> sequences;
  while (sequences.size() < 2) {
    for (const TakenPicture& picture : await_ready(thread)) {
      sequences.push_back(picture.colour.sequence);
    }
  }
  EXPECT_EQ(sequences, (std::vector<std::uint64_t>{1, 3}));
}

}  // namespace
}  // namespace flyball
