// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Draws the colour camera's pictures beside the simulator, which has to keep its times.

#include "flyball/runtime/colour_frame.h"
#include "flyball/runtime/messages.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace flyball {

struct TakenPicture {
  ColourFrame colour{};
  DepthFrame depth{};  ///< Which was captured last when the picture was.
};

/// A thread that computes one picture after the other and runs only while the simulator sleeps, as
/// far as the system allows that. For flights in real time: when a picture is ready depends on the
/// host. All functions are for the thread that made it.
class PictureThread {
 public:
  PictureThread();
  /// Waits for the picture that is being drawn; what else waits is dropped.
  ~PictureThread();
  PictureThread(const PictureThread&) = delete;
  PictureThread& operator=(const PictureThread&) = delete;

  /// Has a picture drawn. It takes the place of one that still waits to be begun, as in a camera
  /// that cannot keep up with its rate.
  void draw(TakenPicture picture);
  /// Those that are ready and were not taken yet, in the order in which they were captured.
  [[nodiscard]] std::vector<TakenPicture> take_ready();

 private:
  void run();

  std::mutex mutex_{};
  std::condition_variable news_{};
  std::optional<TakenPicture> next_{};  ///< Waits to be begun.
  std::vector<TakenPicture> ready_{};
  bool is_ending_{};
  std::thread thread_{};
};

}  // namespace flyball
