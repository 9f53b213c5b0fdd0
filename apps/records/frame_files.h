// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Pictures that a mission took: as files of its own, and inside its page.

#include "flyball/records/mission_frame.h"
#include "flyball/runtime/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// RFC 4648, section 4.
[[nodiscard]] std::string base64_of(std::string_view content);

/// Writes frame_1.png, frame_2.png, ... into the folder.
///
/// @return HTML that shows them with their captions, without further files; empty for no frames.
/// @error  `unavailable` when the folder cannot be written.
[[nodiscard]] Result<std::string> write_frames(const std::string& folder,
                                               const std::vector<MissionFrame>& frames);

}  // namespace flyball
