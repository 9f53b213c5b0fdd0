// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What all detectors do with an image before, and with their boxes after.

#include "flyball/kernels/detector.h"

#include <vector>

namespace flyball {

/// @error `invalid_input`, as `Detector::detect` says.
[[nodiscard]] Status check_detector_input(const ColourImage& image, double scale);

/// Surest first (of equally sure ones, from the upper left), without those that overlap a surer one
/// by more than `most_overlap`: greedy non-maximum suppression.
[[nodiscard]] std::vector<Detection> keep_best(std::vector<Detection> found, double most_overlap);

}  // namespace flyball
