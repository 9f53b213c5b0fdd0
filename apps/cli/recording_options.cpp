// SPDX-License-Identifier: BSD-3-Clause

#include "recording_options.h"

#include "flyball/records/text_table.h"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

constexpr double most_px = 1e6;
// Of 16 bits: a whole image within .7 mm, or 65 km; beyond that somebody has mistyped it.
constexpr double least_factor = 1e-3;
constexpr double most_factor = 1e8;

Status check(const RecordingSettings& settings) {
  const auto& k = settings.intrinsics;
  if (!std::all_of(k.begin(), k.end(), [](double px) { return std::abs(px) <= most_px; })) {
    return Error{ErrorCode::invalid_input,
                 "--intrinsics must be numbers of pixels, up to " + rounded(most_px, 0)};
  }
  if (!k.empty() && !(k[0] > 0.0 && k[1] > 0.0)) {
    return Error{ErrorCode::invalid_input, "--intrinsics: focal lengths " + rounded(k[0], 3) +
                                               " and " + rounded(k[1], 3) +
                                               " must be above 0 pixels"};
  }
  if (!(settings.depth_factor >= least_factor && settings.depth_factor <= most_factor)) {
    return Error{ErrorCode::invalid_input, "--depth-factor " + rounded(settings.depth_factor, 3) +
                                               " must be from " + rounded(least_factor, 3) +
                                               " to " + rounded(most_factor, 0)};
  }
  return Done{};
}

}  // namespace

void add_recording_options(CLI::App& command, RecordingOptions& options) {
  command
      .add_option("RECORDING", options.folder,
                  "the folder of a recording in the layout of TUM RGB-D or EuRoC")
      ->required();
  command
      .add_option("--intrinsics", options.settings.intrinsics,
                  "in pixels, in place of those of the recording")
      ->delimiter(',')
      ->type_name("fx,fy,cx,cy")
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
