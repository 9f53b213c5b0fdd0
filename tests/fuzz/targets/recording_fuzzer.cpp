// SPDX-License-Identifier: BSD-3-Clause
//
// The text files of a recording, in TUM's layout and in EuRoC's, with lines of dashes between. Its
// images are sound: png_fuzzer.cpp has those that are not.

#include "flyball/recordings/recording.h"

#include "input_folder.h"
#include "png_writer.h"
#include <cmath>

namespace {

std::string as_tum(const std::vector<std::string_view>& files) {
  static const InputFolder folder;
  static const std::vector<std::uint8_t> grey(16 * 12, 7);
  static const auto image = folder.path("1.png");
  static const bool written = (flyball::kit::write_png(image, 16, 12, grey), true);
  require(written, "written");
  folder.write("rgb.txt", files[0]);
  folder.write("depth.txt", files[1]);
  folder.write("groundtruth.txt", files[2]);
  folder.write("accelerometer.txt", files[3]);
  folder.write("gyroscope.txt", files[4]);
  return folder.path();
}

std::string as_euroc(const std::vector<std::string_view>& files) {
  static const InputFolder folder;
  static const std::vector<std::uint8_t> grey(16 * 12, 7);
  folder.write("mav0/cam0/data.csv", files[0]);
  folder.write("mav0/cam0/sensor.yaml", files[1]);
  folder.write("mav0/state_groundtruth_estimate0/data.csv", files[2]);
  folder.write("mav0/imu0/data.csv", files[3]);
  folder.write("mav0/cam0/data/x", "");
  static const auto image = folder.path("mav0/cam0/data/1.png");
  static const bool written = (flyball::kit::write_png(image, 16, 12, grey), true);
  require(written, "written");
  return folder.path();
}

void check(const flyball::Result<flyball::Recording>& read) {
  if (!read) {
    require(!read.error().message.empty(), "what is refused is refused in words");
    return;
  }
  require(!read->frames.empty(), "it has frames");
  require(read->X_BC.matrix().allFinite(), "the camera has a place");
  require(std::isfinite(read->camera.focal_x_px + read->camera.focal_y_px), "it has a lens");
  for (const flyball::TimedPose& pose : read->truth) {
    require(pose.X_WB.matrix().allFinite(), "a pose is finite");
  }
  for (std::size_t i = 1; i < read->imu.size(); ++i) {
    require(read->imu[i - 1].stamp <= read->imu[i].stamp, "time runs forward");
    require(read->imu[i].f_B.allFinite() && read->imu[i].w_WB_B.allFinite(), "finite samples");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  auto files = pieces_of(text_of(bytes, size));
  files.resize(5);
  check(flyball::read_recording(as_tum(files), {}));
  check(flyball::read_recording(as_euroc(files), {}));
  return 0;
}
