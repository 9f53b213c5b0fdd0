// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace flyball::kit {

/// Folder of the platforms, airframes and presets that were built beside the test program.
inline std::string built_data() {
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  return (program.parent_path().parent_path() / "share" / "flyball").string();
}

}  // namespace flyball::kit
