// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The image files of recordings.

#include "flyball/recordings/recording.h"

namespace flyball {

/// Sets the camera's size to that of the first image.
/// @error As `load_frame`.
[[nodiscard]] Status size_from_image(Recording& recording);

}  // namespace flyball
