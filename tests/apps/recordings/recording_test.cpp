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
  EXPECT_EQ(recording->text_files.size(), 6U);
  EXPECT_EQ(recording->text_files.front(), written.place.path("associations.txt"));
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

/// 8 x 8 pixels, all of red 90, green 200, blue 30: written by OpenCV, quality 90.
constexpr std::string_view green_jpeg =
    "ffd8ffe000104a46494600010100000100010000ffdb00430003020203020203030303040303040508050504"
    "04050a070706080c0a0c0c0b0a0b0b0d0e12100d0e110e0b0b1016101113141515150c0f1718161418121415"
    "14ffdb00430103040405040509050509140d0b0d141414141414141414141414141414141414141414141414"
    "1414141414141414141414141414141414141414141414141414ffc000110800080008030122000211010311"
    "01ffc4001500010100000000000000000000000000000006ffc4001410010000000000000000000000000000"
    "0000ffc4001501010100000000000000000000000000000708ffc40014110100000000000000000000000000"
    "000000ffda000c03010002110311003f00b50127849fffd9";

std::string bytes_of(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string{hex.substr(i, 2)}, nullptr, 16));
  }
  return bytes;
}

TEST(TumRecording, refuses_images_that_run_back_in_time) {
  const WrittenTum written;
  const std::string later = "2.0 rgb/2.000000.png 2.0 depth/2.000000.png\n";
  const std::string sooner = "1.5 rgb/1.500000.png 1.5 depth/1.500000.png\n";
  const std::string why = ":2: the time 1.5 is earlier than that of the line before";
  (void)written.place.file("associations.txt", later + sooner);
  EXPECT_NE(written.refused().find("associations.txt" + why), std::string::npos);
  written.remove("associations.txt");
  for (const char* name : {"depth.txt", "rgb.txt"}) {
    (void)written.place.file(name, later + sooner);
    EXPECT_NE(written.refused().find(name + why), std::string::npos) << written.refused();
  }
}

TEST(TumRecording, reads_jpeg_too_whatever_the_file_is_called) {
  const WrittenTum written;
  kit::write_png(written.place.path("depth/a.png"), 8, 8, std::vector<std::uint16_t>(64, 10000));
  (void)written.place.file("rgb/a.jpg", bytes_of(green_jpeg));
  (void)written.place.file("rgb/b.png", bytes_of(green_jpeg));
  (void)written.place.file("associations.txt",
                           "1.0 rgb/a.jpg 1.0 depth/a.png\n1.1 rgb/b.png 1.1 depth/a.png\n");
  const auto recording = written.read();
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->camera.width_px, 8);
  for (const std::size_t i : {0U, 1U}) {
    const auto frame = load_frame(*recording, i);
    ASSERT_TRUE(frame) << frame.error().message;
    ASSERT_EQ(frame->grey.size(), 64U);
    EXPECT_NEAR(frame->grey[30], 148, 2) << "ITU-R BT.601";
    EXPECT_NEAR(frame->depth_m[5], 2.0, 1e-6);
  }
  (void)written.place.file("rgb/a.jpg", bytes_of(green_jpeg).substr(0, 100));
  EXPECT_NE(written.refused().find("rgb/a.jpg\": the JPEG image is cut off"), std::string::npos)
      << written.refused();
}

TEST(TumRecording, has_inertial_measurements_where_both_sensors_were_recorded) {
  const WrittenTum written;
  (void)written.place.file("accelerometer.txt",
                           "# timestamp ax ay az\n1.00 0 0 9.8\n1.02 2 0 9.8\n");
  const auto accel_only = written.read();
  ASSERT_TRUE(accel_only) << accel_only.error().message;
  EXPECT_TRUE(accel_only->imu.empty());
  EXPECT_TRUE(accel_only->lacks_gyro);
  (void)written.place.file("gyroscope.txt",
                           "0.99 9 9 9\n1.00 0.1 0 0\n1.01 0.2 0 0.3\n1.03 9 9 9\n");
  const auto recording = written.read();
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_FALSE(recording->lacks_gyro);
  ASSERT_EQ(recording->imu.size(), 2U) << "where both sensors were on";
  EXPECT_EQ(recording->imu[0].f_B, (Vec3{0.0, 0.0, 9.8}));
  EXPECT_EQ(recording->imu[1].stamp, at(1.01));
  EXPECT_EQ(recording->imu[1].w_WB_B, (Vec3{0.2, 0.0, 0.3}));
  EXPECT_TRUE(recording->imu[1].f_B.isApprox(Vec3(1.0, 0.0, 9.8), 1e-9)) << "in between";
}

TEST(TumRecording, refuses_inertial_measurements_that_are_wrong_or_run_back_in_time) {
  const WrittenTum written;
  (void)written.place.file("gyroscope.txt", "1.0 0 0 0\n");
  (void)written.place.file("accelerometer.txt", "1.01 0 0 9.8\n1.00 0 0 9.8\n");
  EXPECT_NE(written.refused().find("accelerometer.txt:2: the time 1.00 is earlier"),
            std::string::npos)
      << written.refused();
  (void)written.place.file("accelerometer.txt", "1.00 0 0\n");
  EXPECT_NE(written.refused().find("accelerometer.txt:1: 3 columns"), std::string::npos);
  (void)written.place.file("accelerometer.txt", "1.00 0 0 9.8\n");
  (void)written.place.file("gyroscope.txt", "soon 0 0 0\n");
  EXPECT_NE(written.refused().find("gyroscope.txt:1: \"soon\" is no time"), std::string::npos);
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

}  // namespace
}  // namespace flyball
