// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Recorded flights: images, depth, inertial measurements and the true path, from a folder.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/imu.h"
#include "flyball/runtime/result.h"

#include <string>
#include <vector>

namespace flyball {

struct TimedPose {
  MissionTime stamp{};
  Pose X_WB{Pose::Identity()};
};

struct RecordedFrame {
  MissionTime stamp{};
  std::string grey_file{};
  std::string depth_file{};  ///< Empty when there is no depth.
};

struct Recording {
  CameraModel camera{};  ///< Its size is that of the first image.
  Pose X_BC{Pose::Identity()};
  double depth_factor{5000.0};  ///< Of the 16-bit depth image: so many units are a metre.
  std::vector<RecordedFrame> frames{};
  std::vector<ImuSample> imu{};
  bool lacks_gyro{};               ///< There is an accelerometer, but no gyro beside it.
  std::vector<TimedPose> truth{};  ///< Of the body; empty when the folder does not say.
  /// Those that its layout has beside the images, whether or not they are there.
  std::vector<std::string> text_files{};
};

struct RecordingSettings {
  /// fx, fy, cx, cy [px]; empty: the layout's own. For TUM that is 525, 525, 319.5, 239.5, the
  /// values that its authors recommend for all of its sequences; EuRoC's are in its sensor.yaml.
  std::vector<double> intrinsics{};
  double depth_factor{5000.0};
};

/// Whether the folder is laid out as EuRoC's recordings (mav0/cam0).
[[nodiscard]] bool is_euroc(const std::string& folder);

/// The layout of the TUM RGB-D benchmark (Sturm et al. 2012, doi:10.1109/IROS.2012.6385773):
/// associations.txt (time, rgb file, time, depth file), or rgb.txt and depth.txt, whose entries are
/// paired when they are less than .02 s apart; groundtruth.txt (time tx ty tz qx qy qz qw) if there
/// is one. Its accelerometer.txt (time ax ay az [m/s^2]) becomes inertial measurements where there
/// is a gyroscope.txt (time wx wy wz [rad/s]) too: TUM's Kinect had no gyro. Both are expressed in
/// the camera's frame, and run forward in time.
/// @error `not_found`, `invalid_input`: one sentence with the file and the line.
[[nodiscard]] Result<Recording> read_tum(const std::string& folder,
                                         const RecordingSettings& settings);

/// The layout of the EuRoC MAV datasets (Burri et al. 2016, doi:10.1177/0278364915620033):
/// mav0/cam0/{data.csv, sensor.yaml, data/}, mav0/imu0/data.csv,
/// mav0/state_groundtruth_estimate0/data.csv if there is one. Only the first camera is read. Its
/// distortion_model is radial-tangential (or radtan), equidistant, or none.
/// @error As `read_tum`; `invalid_input` when images or inertial measurements run back in time, or
///        when the lens has another model.
[[nodiscard]] Result<Recording> read_euroc(const std::string& folder,
                                           const RecordingSettings& settings);

/// Either layout, whichever the folder has.
/// @error As `read_tum` and `read_euroc`.
[[nodiscard]] Result<Recording> read_recording(const std::string& folder,
                                               const RecordingSettings& settings);

/// Reads the images of one frame: PNG or JPEG, depth as 16-bit PNG.
/// @error `invalid_input` when a file is missing, is no image, or has another size than the first.
[[nodiscard]] Result<VisualFrame> load_frame(const Recording& recording, std::size_t number);

/// Lines `time tx ty tz qx qy qz qw`, in whatever order; the result is in order of time.
/// @error `not_found`, or `invalid_input` with the file and the line.
[[nodiscard]] Result<std::vector<TimedPose>> read_tum_trajectory(const std::string& file);

/// As lines `time tx ty tz qx qy qz qw`, which TUM's tools read.
/// @error `failed` when the file cannot be written.
[[nodiscard]] Status write_tum_trajectory(const std::string& file,
                                          const std::vector<TimedPose>& poses);

}  // namespace flyball
