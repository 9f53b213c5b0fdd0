// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The real depth camera that a command is told to fly with.

#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/result.h"
#include "flyball/vehicles/depth_source.h"

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace flyball {

/// Adds `--depth-camera`.
void add_depth_camera(CLI::App& command, std::string& pipe);

/// The camera; null where `pipe` is empty.
/// @error Those of `open_depth_pipe`.
[[nodiscard]] Result<std::unique_ptr<DepthSource>> open_depth_camera(const std::string& pipe,
                                                                     const DepthCameraSpec& spec);

}  // namespace flyball
