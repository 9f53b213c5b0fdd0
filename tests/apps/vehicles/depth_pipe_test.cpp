// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/vehicles/depth_source.h"

#include "autopilot/pgm_bytes.h"
#include "scratch_folder.h"
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A named pipe, and a clock that a test turns.
struct PipedCamera {
  explicit PipedCamera(int width_px = 2, int height_px = 1) {
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    settings.width_px = width_px;
    settings.height_px = height_px;
    settings.tell = [this](const std::string& sentence) { told += sentence + "\n"; };
    settings.clock = [this] { return Duration{now_ns.load()}; };
    auto opened = open_depth_pipe(path, settings);
    EXPECT_TRUE(opened) << opened.error().message;
    source = std::move(*opened);
    writer = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  }
  ~PipedCamera() { close_writer(); }
  PipedCamera(const PipedCamera&) = delete;
  PipedCamera& operator=(const PipedCamera&) = delete;

  void close_writer() {
    if (writer >= 0) {
      close(writer);
      writer = -1;
    }
  }
  void send(const std::string& bytes) const {
    EXPECT_EQ(write(writer, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  void turn_clock(Duration by) { now_ns += by.count(); }
  /// Waits for the reader's thread, however long that takes.
  DepthReading next() const {
    for (;;) {
      if (auto taken = source->take()) {
        return *taken;
      }
      std::this_thread::sleep_for(1ms);
    }
  }

  ScratchFolder folder{};
  std::string path{folder.path("camera")};
  std::string told{};
  std::atomic<std::int64_t> now_ns{0};
  DepthPipeSettings settings{};
  std::unique_ptr<DepthSource> source{};
  int writer{-1};
};

TEST(DepthPipe, turns_millimetres_into_metres_and_knows_what_was_not_measured) {
  PipedCamera camera{4, 1};
  camera.turn_clock(3s);
  camera.send(kit::pgm_bytes(4, 1, {1500, 0, 65535, 20}));
  ASSERT_TRUE(camera.source->await({}));
  const DepthReading reading = camera.next();
  EXPECT_EQ(reading.arrived, Duration{3s});
  ASSERT_EQ(reading.depth_m.size(), 4U);
  EXPECT_FLOAT_EQ(reading.depth_m[0], 1.5F);
  EXPECT_TRUE(std::isnan(reading.depth_m[1]));
  EXPECT_FLOAT_EQ(reading.depth_m[2], 65.535F);  // Beyond all cameras: free up to there.
  EXPECT_FLOAT_EQ(reading.depth_m[3], 0.02F);
  EXPECT_FALSE(camera.source->take());
}

TEST(DepthPipe, refuses_images_of_another_size) {
  PipedCamera camera;
  camera.send(kit::pgm_bytes(3, 1, {1, 2, 3}));
  const Status seen = camera.source->await({});
  ASSERT_FALSE(seen);
  EXPECT_EQ(seen.error().message,
            "the depth camera sends 3 x 1 pixels, and the scenario says 2 x 1 pixels; set "
            "camera.width_px and camera.height_px");
}

TEST(DepthPipe, tells_once_that_no_images_come_and_that_they_come_again) {
  PipedCamera camera;
  camera.send(kit::pgm_bytes(2, 1, {1, 2}));
  (void)camera.next();
  camera.turn_clock(1s);
  EXPECT_FALSE(camera.source->take());
  EXPECT_EQ(camera.told, "");
  camera.turn_clock(1ms);
  EXPECT_FALSE(camera.source->take());
  EXPECT_FALSE(camera.source->take());
  EXPECT_EQ(camera.told, "the depth camera has sent no image for 1 s\n");
  camera.send(kit::pgm_bytes(2, 1, {1, 2}));
  (void)camera.next();
  EXPECT_EQ(camera.told,
            "the depth camera has sent no image for 1 s\nthe depth camera sends images again\n");
}

TEST(DepthPipe, says_why_when_the_other_end_is_closed) {
  PipedCamera camera;
  camera.send(kit::pgm_bytes(2, 1, {1, 2}));
  (void)camera.next();
  camera.close_writer();
  while (camera.told.empty()) {
    camera.turn_clock(2s);
    (void)camera.source->take();
    std::this_thread::sleep_for(1ms);
  }
  // How far the thread has come when the silence is noticed is up to the host.
  EXPECT_EQ(camera.told.find("the depth camera has sent no image for 1 s"), 0U);
}

TEST(DepthPipe, stops_waiting_when_it_is_told_to_or_nobody_sends) {
  PipedCamera camera;
  const Status stopped = camera.source->await([] { return true; });
  ASSERT_FALSE(stopped);
  const Status silent = camera.source->await([&camera] {
    camera.turn_clock(10s);
    return false;
  });
  ASSERT_FALSE(silent);
  EXPECT_EQ(silent.error().message, "the depth camera has sent no image within 15 s");
}

TEST(DepthPipe, refuses_what_is_no_pipe) {
  const ScratchFolder folder;
  for (const std::string& name :
       {folder.file("image.pgm", kit::pgm_bytes(1, 1, {1})), folder.path()}) {
    const auto opened = open_depth_pipe(name, {1, 1, {}, [] { return Duration{}; }});
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.error().message.find("is no pipe"), std::string::npos);
  }
  const auto missing = open_depth_pipe(folder.path("x"), {1, 1, {}, [] { return Duration{}; }});
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("cannot open"), std::string::npos);
}

}  // namespace
}  // namespace flyball
