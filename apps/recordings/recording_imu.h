// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Inertial measurements of recordings in TUM's layout.

#include "flyball/recordings/recording.h"

namespace flyball {

constexpr const char* accelerometer_file = "accelerometer.txt";
constexpr const char* gyroscope_file = "gyroscope.txt";

/// Fills `imu` where the folder has accelerometer.txt and gyroscope.txt: a sample at each time of
/// the gyro, with the specific force in between those of the accelerometer.
/// @error `invalid_input`: names the file and the line that is wrong, or runs back in time.
[[nodiscard]] Status read_tum_imu(const std::string& folder, Recording& recording);

}  // namespace flyball
