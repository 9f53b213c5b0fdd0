// SPDX-License-Identifier: BSD-3-Clause
// tested-in: recording

#include "recordings/recording_imu.h"

#include "recordings/recording_text.h"
#include <algorithm>
#include <filesystem>
#include <system_error>

namespace flyball {
namespace {

namespace fs = std::filesystem;

struct Felt {
  MissionTime stamp{};
  Vec3 value{Vec3::Zero()};
};

Result<std::vector<Felt>> read_felt(const std::string& file) {
  const auto lines = read_lines(file);
  if (!lines) {
    return lines.error();
  }
  std::vector<Felt> felt;
  for (const TextLine& line : *lines) {
    const auto stamp = to_time(line.words.front());
    const auto v = numbers_of(file, line, 1, 3);
    if (!stamp || !v) {
      return stamp ? v.error() : wrong(file, line, "\"" + line.words.front() + "\" is no time");
    }
    if (const Status ordered =
            check_order(file, line, felt.empty() ? *stamp : felt.back().stamp, *stamp);
        !ordered) {
      return ordered.error();
    }
    felt.push_back({*stamp, Vec3{(*v)[0], (*v)[1], (*v)[2]}});
  }
  return felt;
}

/// In between two samples; empty before the first and after the last.
std::optional<Vec3> value_at(const std::vector<Felt>& felt, MissionTime t) {
  const auto after =
      std::lower_bound(felt.begin(), felt.end(), t,
                       [](const Felt& one, MissionTime time) { return one.stamp < time; });
  if (after == felt.end() || (after == felt.begin() && after->stamp != t)) {
    return std::nullopt;
  }
  if (after->stamp == t) {
    return after->value;
  }
  const Felt& before = *(after - 1);
  const double share = to_seconds(t - before.stamp) / to_seconds(after->stamp - before.stamp);
  return (1.0 - share) * before.value + share * after->value;
}

}  // namespace

Status read_tum_imu(const std::string& folder, Recording& recording) {
  const std::string accel_file = (fs::path{folder} / accelerometer_file).string();
  const std::string gyro_file = (fs::path{folder} / gyroscope_file).string();
  std::error_code failed;
  if (!fs::exists(accel_file, failed)) {
    return Done{};
  }
  const auto accel = read_felt(accel_file);
  if (!accel) {
    return accel.error();
  }
  recording.lacks_gyro = !fs::exists(gyro_file, failed);
  if (recording.lacks_gyro) {
    return Done{};
  }
  const auto gyro = read_felt(gyro_file);
  if (!gyro) {
    return gyro.error();
  }
  for (const Felt& turn : *gyro) {
    if (const auto f_B = value_at(*accel, turn.stamp)) {
      recording.imu.push_back({turn.stamp, turn.value, *f_B});
    }
  }
  return Done{};
}

}  // namespace flyball
