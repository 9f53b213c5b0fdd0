// SPDX-License-Identifier: BSD-3-Clause

#include "recording_options.h"

#include "flyball/records/text_table.h"

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

Status check(const RecordingSettings& settings) {
  const auto& k = settings.intrinsics;
  if (!k.empty() && !(k[0] > 0.0 && k[1] > 0.0)) {
    return Error{ErrorCode::invalid_input, "--intrinsics: focal lengths " + rounded(k[0], 3) +
                                               " and " + rounded(k[1], 3) +
                                               " must be above 0 pixels"};
  }
  if (!(settings.depth_factor > 0.0)) {
    return Error{ErrorCode::invalid_input,
                 "--depth-factor " + rounded(settings.depth_factor, 3) + " must be above 0"};
  }
  return Done{};
}

}  // namespace

void add_recording_options(CLI::App& command, RecordingOptions& options) {
  command.add_option("DIR", options.folder, "the folder of the recording")->required();
  command
      .add_option("--intrinsics", options.settings.intrinsics,
                  "fx,fy,cx,cy in pixels, in place of the layout's own")
      ->delimiter(',')
      ->expected(4);
  command.add_option("--depth-factor", options.settings.depth_factor,
                     "units of the depth image in a metre; 5000 by default");
}

Result<Recording> read_recording(const RecordingOptions& options) {
  if (const Status usable = check(options.settings); !usable) {
    return usable.error();
  }
  return read_recording(options.folder, options.settings);
}

}  // namespace flyball
