// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/recording.h"

#include "recordings/recording_images.h"
#include "recordings/recording_text.h"
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

namespace flyball {
namespace {

namespace fs = std::filesystem;

constexpr const char* images_of_euroc = "cam0/data.csv";
constexpr const char* camera_of_euroc = "cam0/sensor.yaml";
constexpr const char* imu_of_euroc = "imu0/data.csv";
constexpr const char* imu_calibration_of_euroc = "imu0/sensor.yaml";  // Other tools read it.
constexpr const char* truth_of_euroc = "state_groundtruth_estimate0/data.csv";

std::string in_mav0(const std::string& folder, const std::string& name) {
  return (fs::path{folder} / "mav0" / name).string();
}

/// The numbers between the first brackets after `key:`. Enough of YAML for these files, whose every
/// list is written so.
Result<std::vector<double>> list_of(const std::string& file,
                                    const std::string& text,
                                    const std::string& key,
                                    std::size_t count) {
  const std::size_t at = text.find("\n" + key + ":");
  const std::size_t open = at == std::string::npos ? at : text.find('[', at);
  const std::size_t close = open == std::string::npos ? open : text.find(']', open);
  std::vector<double> numbers;
  if (close != std::string::npos) {
    std::string word;
    for (const char c : text.substr(open + 1, close - open - 1) + ",") {
      if (c != ',') {
        word += std::isspace(static_cast<unsigned char>(c)) != 0 ? "" : std::string{c};
      } else if (const auto value = to_number(word)) {
        numbers.push_back(*value);
        word.clear();
      }
    }
  }
  if (numbers.size() != count) {
    return Error{ErrorCode::invalid_input,
                 file + ": " + key + " must be a list of " + std::to_string(count) + " numbers"};
  }
  return numbers;
}

/// The word behind `key:` at the start of a line, without quotes; `otherwise` where there is none.
std::string word_of(const std::string& text, const std::string& key, const std::string& otherwise) {
  const std::size_t at = text.find("\n" + key + ":");
  if (at == std::string::npos) {
    return otherwise;
  }
  const std::size_t from = at + key.size() + 2;
  std::istringstream rest{text.substr(from, text.find('\n', from) - from)};
  std::string word;
  rest >> word;
  word.erase(std::remove_if(word.begin(), word.end(), [](char c) { return c == '"' || c == '\''; }),
             word.end());
  return word;
}

/// EuRoC writes "radial-tangential", Kalibr "radtan" for the same formula.
Status read_lens(const std::string& file, const std::string& text, CameraModel& camera) {
  const std::string kind = word_of(text, "camera_model", "pinhole");
  if (kind != "pinhole") {
    return Error{ErrorCode::invalid_input,
                 file + ": camera_model \"" + kind + "\" is not known; it must be pinhole"};
  }
  const std::string model = word_of(text, "distortion_model", "radial-tangential");
  if (model == "none") {
    return Done{};
  }
  const bool is_radial = model == "radial-tangential" || model == "radtan";
  if (!is_radial && model != "equidistant") {
    return Error{ErrorCode::invalid_input,
                 file + ": distortion_model \"" + model +
                     "\" is not known; there are: radial-tangential (radtan), equidistant, none"};
  }
  const auto distortion = list_of(file, text, "distortion_coefficients", 4);
  if (!distortion) {
    return distortion.error();
  }
  camera.distortion_model =
      is_radial ? DistortionModel::radial_tangential : DistortionModel::equidistant;
  std::copy(distortion->begin(), distortion->end(), camera.distortion.begin());
  return Done{};
}

Status read_camera(const std::string& file, Recording& recording) {
  std::error_code failed;
  std::ifstream in_file{file};
  if (!in_file || !fs::is_regular_file(file, failed)) {
    return Error{ErrorCode::not_found, "cannot read \"" + file + "\""};
  }
  const std::string text = "\n" + std::string{std::istreambuf_iterator<char>{in_file}, {}};
  const auto intrinsics = list_of(file, text, "intrinsics", 4);
  if (!intrinsics) {
    return intrinsics.error();
  }
  // T_BS's list stands one level deeper: data: [...].
  const std::size_t pose_at = text.find("\nT_BS:");
  const std::size_t data_at = pose_at == std::string::npos ? pose_at : text.find("data:", pose_at);
  const auto X =
      list_of(file, data_at == std::string::npos ? "" : "\n" + text.substr(data_at), "data", 16);
  if (!X) {
    return X.error();
  }
  recording.camera = {0, 0, (*intrinsics)[0], (*intrinsics)[1], (*intrinsics)[2], (*intrinsics)[3],
                      {}};
  if (Status lens = read_lens(file, text, recording.camera); !lens) {
    return lens;
  }
  Eigen::Matrix3d R;
  R << (*X)[0], (*X)[1], (*X)[2], (*X)[4], (*X)[5], (*X)[6], (*X)[8], (*X)[9], (*X)[10];
  recording.X_BC.linear() = Eigen::Quaterniond{R}.normalized().toRotationMatrix();
  recording.X_BC.translation() = Vec3{(*X)[3], (*X)[7], (*X)[11]};
  return Done{};
}

Status read_images(const std::string& folder, Recording& recording) {
  const std::string file = in_mav0(folder, images_of_euroc);
  const auto lines = read_lines(file);
  if (!lines) {
    return lines.error();
  }
  for (const TextLine& line : *lines) {
    const auto stamp = to_time(line.words.front());
    if (!stamp || line.words.size() < 2) {
      return wrong(file, line, "expected a time in nanoseconds and a file name");
    }
    const MissionTime last = recording.frames.empty() ? *stamp : recording.frames.back().stamp;
    if (Status ordered = check_order(file, line, last, *stamp); !ordered) {
      return ordered;
    }
    recording.frames.push_back({*stamp, in_mav0(folder, "cam0/data/" + line.words[1]), ""});
  }
  if (recording.frames.empty()) {
    return Error{ErrorCode::invalid_input, "\"" + file + "\" names no image"};
  }
  return size_from_image(recording);
}

Status read_imu(const std::string& folder, Recording& recording) {
  const std::string file = in_mav0(folder, imu_of_euroc);
  const auto lines = read_lines(file);
  if (!lines) {
    return lines.error();
  }
  for (const TextLine& line : *lines) {
    const auto stamp = to_time(line.words.front());
    const auto values = numbers_of(file, line, 1, 6);
    if (!stamp || !values) {
      return stamp ? values.error() : wrong(file, line, "expected a time in nanoseconds");
    }
    const MissionTime last = recording.imu.empty() ? *stamp : recording.imu.back().stamp;
    if (Status ordered = check_order(file, line, last, *stamp); !ordered) {
      return ordered;
    }
    const auto& v = *values;
    recording.imu.push_back({*stamp, Vec3{v[0], v[1], v[2]}, Vec3{v[3], v[4], v[5]}});
  }
  return Done{};
}

Status read_truth(const std::string& folder, Recording& recording) {
  const std::string file = in_mav0(folder, truth_of_euroc);
  if (std::error_code failed; !fs::exists(file, failed)) {
    return Done{};
  }
  const auto lines = read_lines(file);
  if (!lines) {
    return lines.error();
  }
  for (const TextLine& line : *lines) {
    const auto stamp = to_time(line.words.front());
    const auto values = numbers_of(file, line, 1, 7);
    if (!stamp || !values) {
      return stamp ? values.error() : wrong(file, line, "expected a time in nanoseconds");
    }
    const auto& v = *values;
    const Eigen::Quaterniond q{v[3], v[4], v[5], v[6]};
    if (q.norm() < 0.5) {
      return wrong(file, line, "the quaternion has no length");
    }
    TimedPose pose{*stamp, Pose::Identity()};
    pose.X_WB.translation() = Vec3{v[0], v[1], v[2]};
    pose.X_WB.linear() = q.normalized().toRotationMatrix();
    recording.truth.push_back(pose);
  }
  std::stable_sort(recording.truth.begin(), recording.truth.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.stamp < b.stamp; });
  return Done{};
}

}  // namespace

bool is_euroc(const std::string& folder) {
  std::error_code failed;
  return fs::is_directory(in_mav0(folder, "cam0"), failed);
}

Result<Recording> read_euroc(const std::string& folder, const RecordingSettings& settings) {
  Recording recording;
  if (const Status read = read_camera(in_mav0(folder, camera_of_euroc), recording); !read) {
    return read.error();
  }
  if (settings.intrinsics.size() == 4) {
    recording.camera.focal_x_px = settings.intrinsics[0];
    recording.camera.focal_y_px = settings.intrinsics[1];
    recording.camera.centre_x_px = settings.intrinsics[2];
    recording.camera.centre_y_px = settings.intrinsics[3];
  }
  for (const char* name :
       {images_of_euroc, camera_of_euroc, imu_of_euroc, imu_calibration_of_euroc, truth_of_euroc}) {
    recording.text_files.push_back(in_mav0(folder, name));
  }
  for (const auto& read : {read_images, read_imu, read_truth}) {
    if (const Status done = read(folder, recording); !done) {
      return done.error();
    }
  }
  return recording;
}

}  // namespace flyball
