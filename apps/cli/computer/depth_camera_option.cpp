// SPDX-License-Identifier: BSD-3-Clause
// tested-in: autopilot_command
#include "cli/computer/depth_camera_option.h"

#include "cli/computer/host_clock.h"
#include "cli/console.h"
#include "cli/flight_options.h"

#include <CLI/CLI.hpp>

namespace flyball {

void add_depth_camera(CLI::App& command, std::string& pipe) {
  refuse_empty(*command
                    .add_option("--depth-camera", pipe,
                                "with --autopilot: depth images of a real camera, instead of drawn "
                                "ones: a pipe, or - for standard input, of 16-bit PGM in "
                                "millimetres")
                    ->type_name("PIPE"));
}

Result<std::unique_ptr<DepthSource>> open_depth_camera(const std::string& pipe,
                                                       const DepthCameraSpec& spec) {
  if (pipe.empty()) {
    return std::unique_ptr<DepthSource>{};
  }
  DepthPipeSettings settings;
  settings.width_px = spec.width_px;
  settings.height_px = spec.height_px;
  settings.tell = [](const std::string& sentence) { remark(sentence); };
  settings.clock = host_clock;
  return open_depth_pipe(pipe, settings);
}

}  // namespace flyball
