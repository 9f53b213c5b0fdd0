// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How far an estimated path is from the true one.

#include "flyball/recordings/recording.h"

#include <optional>

namespace flyball {

/// Absolute trajectory error of Sturm et al. 2012 (doi:10.1109/IROS.2012.6385773, section IV).
struct TrajectoryError {
  int pairs{};
  double rmse_m{};
  double mean_m{};
  double median_m{};
  double max_m{};
  double path_m{};  ///< Length of the true path between the first and the last pair.
};

/// Pairs each estimate with the true pose that is nearest in time, at most .02 s away, aligns the
/// estimated path by the best rigid motion (Horn 1987; Umeyama 1991, doi:10.1109/34.88573, without
/// scale) and measures the remaining error.
/// @return Empty with fewer than three pairs.
[[nodiscard]] std::optional<TrajectoryError> absolute_trajectory_error(
    const std::vector<TimedPose>& estimate, const std::vector<TimedPose>& truth);

}  // namespace flyball
