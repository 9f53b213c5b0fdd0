// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/recording.h"

#include "png_writer.h"
#include "scratch_folder.h"
#include <filesystem>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr const char* sensor_yaml = R"(sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data: [0.0, -1.0, 0.0, -0.02,
         1.0, 0.0, 0.0, -0.06,
         0.0, 0.0, 1.0, 0.01,
         0.0, 0.0, 0.0, 1.0]
rate_hz: 20
resolution: [8, 6]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv
distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
)";

struct WrittenEuroc {
  WrittenEuroc() {
    for (const char* folder : {"cam0/data", "imu0", "state_groundtruth_estimate0"}) {
      std::filesystem::create_directories(place.path("mav0/") + folder);
    }
    (void)place.file("mav0/cam0/sensor.yaml", sensor_yaml);
    (void)place.file("mav0/cam0/data.csv",
                     "#timestamp [ns],filename\r\n1403636579763555584,a.png\r\n");
    kit::write_png(place.path("mav0/cam0/data/a.png"), 8, 6, std::vector<std::uint8_t>(48, 77));
    (void)place.file("mav0/imu0/data.csv",
                     "#timestamp,w,a\n1403636579758555392,-0.1,0.15,0.08,8.18,-0.38,-3.1\n");
    (void)place.file("mav0/state_groundtruth_estimate0/data.csv",
                     "#t,p,q,v\n1403636580838555648,4.6,-1.8,0.8,0.5,-0.15,-0.9,-0.08,0,0,0\n");
  }
  ScratchFolder place;
};

TEST(EurocRecording, has_camera_inertial_measurements_and_truth) {
  const WrittenEuroc written;
  EXPECT_TRUE(is_euroc(written.place.path()));
  const auto recording = read_euroc(written.place.path(), {});
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->camera.focal_x_px, 458.654);
  EXPECT_EQ(recording->camera.width_px, 8);
  EXPECT_EQ(recording->camera.distortion[3], 1.76187114e-05);
  EXPECT_TRUE(recording->X_BC.translation().isApprox(Vec3(-0.02, -0.06, 0.01)));
  EXPECT_NEAR(recording->X_BC.linear()(1, 0), 1.0, 1e-9);
  EXPECT_EQ(recording->text_files.size(), 5U);
  EXPECT_EQ(recording->text_files.front(), written.place.path("mav0/cam0/data.csv"));
  ASSERT_EQ(recording->imu.size(), 1U);
  EXPECT_EQ(recording->imu[0].w_WB_B, (Vec3{-0.1, 0.15, 0.08}));
  EXPECT_EQ(recording->imu[0].f_B, (Vec3{8.18, -0.38, -3.1}));
  ASSERT_EQ(recording->truth.size(), 1U);
  EXPECT_EQ(recording->truth[0].X_WB.translation(), (Vec3{4.6, -1.8, 0.8}));
  const auto frame = load_frame(*recording, 0);
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->depth_m.empty());
  EXPECT_EQ(frame->grey[5], 77);
}

Result<Recording> with_lens(const std::string& lines) {
  const WrittenEuroc written;
  std::string yaml{sensor_yaml};
  yaml.replace(yaml.find("camera_model: pinhole"), 21, lines);
  (void)written.place.file("mav0/cam0/sensor.yaml", yaml);
  return read_euroc(written.place.path(), {});
}

TEST(EurocRecording, knows_the_lens_by_its_name) {
  const auto radial = with_lens("camera_model: pinhole\ndistortion_model: radial-tangential");
  ASSERT_TRUE(radial) << radial.error().message;
  EXPECT_EQ(radial->camera.distortion_model, DistortionModel::radial_tangential);
  EXPECT_TRUE(with_lens("distortion_model: \"radtan\"")) << "Kalibr's name";
  const auto equidistant = with_lens("distortion_model: equidistant");
  ASSERT_TRUE(equidistant);
  EXPECT_EQ(equidistant->camera.distortion_model, DistortionModel::equidistant);
  EXPECT_EQ(equidistant->camera.distortion[0], -0.28340811);
  const auto none = with_lens("distortion_model: none");
  ASSERT_TRUE(none);
  EXPECT_EQ(none->camera.distortion[0], 0.0);
}

TEST(EurocRecording, refuses_a_lens_that_it_does_not_know) {
  EXPECT_NE(
      with_lens("distortion_model: fov")
          .error()
          .message.find("distortion_model \"fov\" is not known; there are: radial-tangential"),
      std::string::npos);
  EXPECT_NE(with_lens("camera_model: omni").error().message.find("camera_model \"omni\""),
            std::string::npos);
}

TEST(EurocRecording, refuses_measurements_that_run_back_in_time) {
  const WrittenEuroc written;
  const auto refused = [&written] {
    const auto recording = read_euroc(written.place.path(), {});
    return recording ? "accepted" : recording.error().message;
  };
  const std::string values = ",-0.1,0.15,0.08,8.18,-0.38,-3.1\n";
  (void)written.place.file("mav0/imu0/data.csv", "1403636579758555392" + values +
                                                     "1403636579763555392" + values +
                                                     "1403636579753555392" + values);
  EXPECT_NE(refused().find("imu0/data.csv:3: the time 1403636579753555392 is earlier than that of "
                           "the line before; sort the lines by time"),
            std::string::npos)
      << refused();
  (void)written.place.file("mav0/imu0/data.csv", "1403636579758555392" + values);
  (void)written.place.file("mav0/cam0/data.csv",
                           "1403636579763555584,a.png\n1403636579763555583,a.png\n");
  EXPECT_NE(refused().find("cam0/data.csv:2: the time"), std::string::npos) << refused();
}

TEST(EurocRecording, refuses_a_true_attitude_without_length) {
  const WrittenEuroc written;
  (void)written.place.file("mav0/state_groundtruth_estimate0/data.csv",
                           "1403636580838555648,4.6,-1.8,0.8,0,0,0,0\n");
  EXPECT_NE(read_euroc(written.place.path(), {}).error().message.find("quaternion has no length"),
            std::string::npos);
}

TEST(EurocRecording, says_what_is_missing) {
  const WrittenEuroc written;
  (void)written.place.file("mav0/cam0/sensor.yaml", "intrinsics: [1, 2]\n");
  EXPECT_NE(read_euroc(written.place.path(), {}).error().message.find("intrinsics must be a list"),
            std::string::npos);
  (void)written.place.file("mav0/cam0/sensor.yaml", sensor_yaml);
  std::filesystem::remove(written.place.path("mav0/imu0/data.csv"));
  EXPECT_NE(read_euroc(written.place.path(), {}).error().message.find("imu0/data.csv"),
            std::string::npos);
}

}  // namespace
}  // namespace flyball
