// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where shipped data lies, and what there is of it.

#include "flyball/runtime/result.h"

#include <string>
#include <vector>

namespace flyball {

/// `kind` is a folder of the share directory: `scenarios`, `presets`, `airframes`, `platforms`,
/// `viewer`. Looked for in the folder that the environment variable FLYBALL_DATA names; without it
/// in ../share/flyball beside the program's own folder, then where this library was installed.
[[nodiscard]] std::string share_folder(const std::string& kind);
/// Stems of the .toml files of a kind, sorted.
[[nodiscard]] std::vector<std::string> shipped(const std::string& kind);
/// Whether it is taken for a path to a file and not for a name.
[[nodiscard]] bool looks_like_path(const std::string& kind, const std::string& text);
/// The file of a bare name, or the path itself when it has a slash or ends in .toml; of
/// `presets` also in .lua or .so.
/// @error `not_found`: lists the command that shows the names. `unavailable`: the file is there,
/// and
///        the system does not let it be read.
[[nodiscard]] Result<std::string> find_shipped(const std::string& kind,
                                               const std::string& name_or_path);

}  // namespace flyball
