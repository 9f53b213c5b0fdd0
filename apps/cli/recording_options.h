// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How a recording is to be read.

#include "flyball/recordings/recording.h"

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
}

namespace flyball {

struct RecordingOptions {
  std::string folder;
  RecordingSettings settings;
};

/// DIR, --intrinsics and --depth-factor.
void add_recording_options(CLI::App& command, RecordingOptions& options);

/// @error As `read_recording`; `invalid_input` when an option makes no sense.
[[nodiscard]] Result<Recording> read_recording(const RecordingOptions& options);

}  // namespace flyball
