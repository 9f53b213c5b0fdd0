// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/recording.h"

#include "flyball/records/report.h"

#include "recordings/recording_images.h"
#include "recordings/recording_imu.h"
#include "recordings/recording_text.h"
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace flyball {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr Duration widest_gap = 20ms;  // TUM's associate.py: --max_difference 0.02.
constexpr double tum_focal_px = 525.0;
constexpr double tum_centre_x_px = 319.5;
constexpr double tum_centre_y_px = 239.5;

constexpr const char* associations_file = "associations.txt";
constexpr const char* images_file = "rgb.txt";
constexpr const char* depths_file = "depth.txt";
constexpr const char* truth_file = "groundtruth.txt";

struct NamedImage {
  MissionTime stamp{};
  std::string file{};
};

std::string in(const std::string& folder, const std::string& name) {
  return (fs::path{folder} / name).string();
}

Result<std::vector<NamedImage>> read_list(const std::string& folder, const std::string& name) {
  const std::string file = in(folder, name);
  const auto lines = read_lines(file);
  if (!lines) {
    return lines.error();
  }
  std::vector<NamedImage> images;
  for (const TextLine& line : *lines) {
    const auto stamp = to_time(line.words.front());
    if (!stamp || line.words.size() < 2) {
      return wrong(file, line, "expected a time and a file name");
    }
    const MissionTime last = images.empty() ? *stamp : images.back().stamp;
    if (const Status ordered = check_order(file, line, last, *stamp); !ordered) {
      return ordered.error();
    }
    images.push_back({*stamp, in(folder, line.words[1])});
  }
  return images;
}

/// Each image with the depth nearest in time, each depth once.
std::vector<RecordedFrame> paired(const std::vector<NamedImage>& images,
                                  const std::vector<NamedImage>& depths) {
  std::vector<RecordedFrame> frames;
  std::size_t next = 0;
  for (const NamedImage& image : images) {
    while (next + 1 < depths.size() && std::chrono::abs(depths[next + 1].stamp - image.stamp) <=
                                           std::chrono::abs(depths[next].stamp - image.stamp)) {
      ++next;
    }
    if (next < depths.size() && std::chrono::abs(depths[next].stamp - image.stamp) < widest_gap) {
      frames.push_back({image.stamp, image.file, depths[next].file});
      ++next;
    }
  }
  return frames;
}

Result<std::vector<RecordedFrame>> read_associations(const std::string& folder) {
  const std::string file = in(folder, associations_file);
  const auto lines = read_lines(file);
  if (!lines) {
    return lines.error();
  }
  std::vector<RecordedFrame> frames;
  for (const TextLine& line : *lines) {
    const auto stamp = to_time(line.words.front());
    if (!stamp || line.words.size() < 4) {
      return wrong(file, line, "expected time, image file, time, depth file");
    }
    const MissionTime last = frames.empty() ? *stamp : frames.back().stamp;
    if (const Status ordered = check_order(file, line, last, *stamp); !ordered) {
      return ordered.error();
    }
    frames.push_back({*stamp, in(folder, line.words[1]), in(folder, line.words[3])});
  }
  return frames;
}

Result<std::vector<RecordedFrame>> read_frames(const std::string& folder) {
  if (std::error_code failed; fs::exists(in(folder, associations_file), failed)) {
    return read_associations(folder);
  }
  const auto images = read_list(folder, images_file);
  const auto depths = images ? read_list(folder, depths_file) : images;
  if (!depths && depths.error().code == ErrorCode::invalid_input) {
    return depths.error();
  }
  if (!depths) {
    return Error{ErrorCode::not_found,
                 "\"" + folder +
                     "\" is no recording: it has neither associations.txt, nor rgb.txt " +
                     "and depth.txt (TUM), nor mav0/cam0 (EuRoC); " + depths.error().message};
  }
  return paired(*images, *depths);
}

}  // namespace

Result<std::vector<TimedPose>> read_tum_trajectory(const std::string& file) {
  std::vector<TimedPose> truth;
  const auto lines = read_lines(file);
  if (!lines) {
    return lines.error();
  }
  for (const TextLine& line : *lines) {
    const auto stamp = to_time(line.words.front());
    const auto p = numbers_of(file, line, 1, 7);
    if (!stamp || !p) {
      return stamp ? p.error() : wrong(file, line, "\"" + line.words.front() + "\" is no time");
    }
    TimedPose pose{*stamp, Pose::Identity()};
    pose.X_WB.translation() = Vec3{(*p)[0], (*p)[1], (*p)[2]};
    const Eigen::Quaterniond q{(*p)[6], (*p)[3], (*p)[4], (*p)[5]};
    if (q.norm() < 0.5) {
      return wrong(file, line, "the quaternion has no length");
    }
    pose.X_WB.linear() = q.normalized().toRotationMatrix();
    truth.push_back(pose);
  }
  std::stable_sort(truth.begin(), truth.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.stamp < b.stamp; });
  return truth;
}

Result<Recording> read_tum(const std::string& folder, const RecordingSettings& settings) {
  if (std::error_code failed; !fs::is_directory(folder, failed)) {
    return Error{ErrorCode::not_found, "no folder \"" + folder + "\" to read a recording from"};
  }
  Recording recording;
  auto frames = read_frames(folder);
  if (!frames) {
    return frames.error();
  }
  if (frames->empty()) {
    return Error{ErrorCode::invalid_input,
                 "\"" + folder + "\" has no image with depth within .02 s of it"};
  }
  recording.frames = std::move(*frames);
  for (const char* name : {associations_file, images_file, depths_file, truth_file,
                           accelerometer_file, gyroscope_file}) {
    recording.text_files.push_back(in(folder, name));
  }
  if (std::error_code failed; fs::exists(in(folder, truth_file), failed)) {
    auto truth = read_tum_trajectory(in(folder, truth_file));
    if (!truth) {
      return truth.error();
    }
    recording.truth = std::move(*truth);
  }
  if (const Status felt = read_tum_imu(folder, recording); !felt) {
    return felt.error();
  }
  recording.depth_factor = settings.depth_factor;
  recording.camera = {0, 0, tum_focal_px, tum_focal_px, tum_centre_x_px, tum_centre_y_px, {}};
  if (settings.intrinsics.size() == 4) {
    recording.camera.focal_x_px = settings.intrinsics[0];
    recording.camera.focal_y_px = settings.intrinsics[1];
    recording.camera.centre_x_px = settings.intrinsics[2];
    recording.camera.centre_y_px = settings.intrinsics[3];
  }
  if (const Status sized = size_from_image(recording); !sized) {
    return sized.error();
  }
  return recording;
}

Result<Recording> read_recording(const std::string& folder, const RecordingSettings& settings) {
  return is_euroc(folder) ? read_euroc(folder, settings) : read_tum(folder, settings);
}

Status write_tum_trajectory(const std::string& file, const std::vector<TimedPose>& poses) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const TimedPose& pose : poses) {
    const Vec3 p = pose.X_WB.translation();
    const Eigen::Quaterniond q{pose.X_WB.linear()};
    const auto ns = pose.stamp.time_since_epoch().count();
    char line[200];
    std::snprintf(line, sizeof line, "%lld.%09lld %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n",
                  static_cast<long long>(ns / 1'000'000'000),
                  static_cast<long long>(ns % 1'000'000'000), p.x(), p.y(), p.z(), q.x(), q.y(),
                  q.z(), q.w());
    text += line;
  }
  return write_file(file, text);
}

}  // namespace flyball
