// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/recording.h"

#include "recordings/recording_text.h"
#include "scratch_folder.h"
#include "tum_sequence.h"
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

VisualFrame frame_at(double t_s) {
  VisualFrame frame;
  frame.captured = at(t_s);
  frame.camera = {8, 6, 4.0, 4.0, 3.5, 2.5, {}};
  for (int i = 0; i < 48; ++i) {
    frame.grey.push_back(static_cast<std::uint8_t>(5 * i));
    frame.depth_m.push_back(i == 7 ? std::numeric_limits<float>::infinity()
                                   : 0.5F + 0.1F * static_cast<float>(i));
  }
  return frame;
}

Pose pose_at(double t_s) {
  Pose X = Pose::Identity();
  X.translation() = Vec3{t_s, -2.0 * t_s, 0.5};
  X.linear() = Eigen::AngleAxisd{0.3 * t_s, Vec3::UnitY()}.toRotationMatrix();
  return X;
}

/// Three frames in a folder of their own.
struct WrittenTum {
  WrittenTum() {
    kit::TumSequence sequence{place.path()};
    for (const double t_s : {1.0, 1.1, 1.2}) {
      sequence.add(frame_at(t_s), pose_at(t_s));
    }
  }
  void remove(const std::string& name) const { std::filesystem::remove(place.path(name)); }
  [[nodiscard]] Result<Recording> read() const { return read_tum(place.path(), {}); }
  [[nodiscard]] std::string refused() const {
    const auto read_back = read();
    return read_back ? "accepted" : read_back.error().message;
  }
  ScratchFolder place;
};

TEST(TumRecording, gives_back_what_was_written) {
  const WrittenTum written;
  const auto recording = written.read();
  ASSERT_TRUE(recording) << recording.error().message;
  ASSERT_EQ(recording->frames.size(), 3U);
  ASSERT_EQ(recording->truth.size(), 3U);
  EXPECT_EQ(recording->camera.width_px, 8);
  EXPECT_EQ(recording->camera.focal_x_px, 525.0);
  EXPECT_TRUE(recording->truth[1].X_WB.isApprox(pose_at(1.1), 1e-6));
  const auto frame = load_frame(*recording, 1);
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->captured, at(1.1));
  const VisualFrame real = frame_at(1.1);
  EXPECT_EQ(frame->grey, real.grey);
  for (std::size_t i = 0; i < real.depth_m.size(); ++i) {
    if (i == 7) {
      EXPECT_FALSE(std::isfinite(frame->depth_m[i])) << "no return";
    } else {
      EXPECT_NEAR(frame->depth_m[i], real.depth_m[i], 1e-4);
    }
  }
}

TEST(TumRecording, pairs_images_and_depth_itself_when_nobody_did) {
  const WrittenTum written;
  written.remove("associations.txt");
  (void)written.place.file("depth.txt",
                           "# comment\n1.015 depth/1.000000.png\n1.19 depth/1.200000.png\n");
  const auto recording = written.read();
  ASSERT_TRUE(recording) << recording.error().message;
  ASSERT_EQ(recording->frames.size(), 2U) << "1.1 has no depth within .02 s";
  EXPECT_EQ(recording->frames[0].stamp, at(1.0));
  EXPECT_EQ(recording->frames[1].stamp, at(1.2));
}

TEST(TumRecording, takes_intrinsics_that_are_given) {
  const WrittenTum written;
  RecordingSettings settings;
  settings.intrinsics = {500.0, 510.0, 4.0, 3.0};
  settings.depth_factor = 1000.0;
  const auto recording = read_tum(written.place.path(), settings);
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->camera.focal_y_px, 510.0);
  EXPECT_NEAR(load_frame(*recording, 0)->depth_m[0], 2.5, 1e-3);
}

TEST(TumRecording, does_without_a_true_path) {
  const WrittenTum written;
  written.remove("groundtruth.txt");
  const auto recording = written.read();
  ASSERT_TRUE(recording);
  EXPECT_TRUE(recording->truth.empty());
}

TEST(TumRecording, says_in_one_sentence_what_is_wrong_with_a_folder) {
  EXPECT_NE(read_tum("no_such_folder", {}).error().message.find("no folder \"no_such_folder\""),
            std::string::npos);
  const ScratchFolder empty;
  EXPECT_NE(read_tum(empty.path(), {}).error().message.find("is no recording"), std::string::npos);
  const WrittenTum written;
  (void)written.place.file("groundtruth.txt", "1.0 1 2 3 0 0 0 1\n1.1 1 two 3 0 0 0 1\n");
  EXPECT_NE(written.refused().find("groundtruth.txt:2: \"two\" is no number"), std::string::npos)
      << written.refused();
  (void)written.place.file("groundtruth.txt", "1.0 1 2 3\n");
  EXPECT_NE(written.refused().find("4 columns, at least 8"), std::string::npos)
      << written.refused();
  (void)written.place.file("groundtruth.txt", "");
  (void)written.place.file("associations.txt", "soon rgb/a.png soon depth/a.png\n");
  EXPECT_NE(written.refused().find("associations.txt:1"), std::string::npos);
  (void)written.place.file("associations.txt", "1.0 rgb/none.png 1.0 depth/none.png\n");
  EXPECT_NE(written.refused().find("rgb/none.png\" as a PNG image"), std::string::npos);
}

TEST(TumRecording, refuses_images_that_are_not_what_they_should_be) {
  const WrittenTum written;
  const auto recording = written.read();
  ASSERT_TRUE(recording);
  std::filesystem::copy_file(written.place.path("rgb/1.000000.png"),
                             written.place.path("depth/1.000000.png"),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NE(load_frame(*recording, 0).error().message.find("16-bit"), std::string::npos);
  kit::write_png(written.place.path("rgb/1.100000.png"), 3, 3, std::vector<std::uint8_t>(9, 0));
  EXPECT_NE(load_frame(*recording, 1).error().message.find("3 x 3 pixels"), std::string::npos);
}

TEST(TumRecording, refuses_a_file_that_is_no_whole_picture) {
  const WrittenTum written;
  const std::string whole = written.place.content("rgb/1.000000.png");
  for (const std::string& damaged :
       {std::string{"no picture"}, whole.substr(0, whole.size() / 2)}) {
    (void)written.place.file("rgb/1.000000.png", damaged);
    EXPECT_NE(written.refused().find("1.000000.png\" as a PNG image"), std::string::npos)
        << written.refused();
  }
}

/// As PNG has it: ISO 3309.
std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
  }
  return ~crc;
}

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24U), static_cast<char>(value >> 16U & 0xFFU),
          static_cast<char>(value >> 8U & 0xFFU), static_cast<char>(value & 0xFFU)};
}

TEST(TumRecording, refuses_a_picture_whose_header_claims_more_than_memory_has) {
  const WrittenTum written;
  const std::string whole = written.place.content("rgb/1.000000.png");
  const std::string ihdr = "IHDR" + big_endian(900'000) + big_endian(900'000) + whole.substr(24, 5);
  (void)written.place.file(
      "rgb/1.000000.png", whole.substr(0, 12) + ihdr + big_endian(crc_of(ihdr)) + whole.substr(33));
  EXPECT_NE(written.refused().find("at most 8192 x 8192 pixels"), std::string::npos)
      << written.refused();
}

TEST(TumTrajectory, is_read_back_to_the_microsecond) {
  const ScratchFolder place;
  const MissionTime t{Duration{1305031102175304000}};
  ASSERT_TRUE(write_tum_trajectory(place.path("path.txt"), {{t, pose_at(1.0)}}));
  EXPECT_NE(place.content("path.txt").find("1305031102.175304000 1.000000 -2.000000 0.500000"),
            std::string::npos)
      << place.content("path.txt");
  EXPECT_FALSE(write_tum_trajectory("/dev/null/path.txt", {}));
}

TEST(RecordedTime, is_seconds_with_a_point_or_nanoseconds_without) {
  EXPECT_EQ(to_time("1305031102.175304")->time_since_epoch().count(), 1305031102175304000);
  EXPECT_EQ(to_time("1403636579763555584")->time_since_epoch().count(), 1403636579763555584);
  EXPECT_EQ(to_time("2")->time_since_epoch().count(), 2000000000);
  for (const char* bad : {"", "x", "-1.0", "1.2.3", "99999999999999999999", "1e5"}) {
    EXPECT_FALSE(to_time(bad)) << bad;
  }
}

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
