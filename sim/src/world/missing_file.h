// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Why a file cannot be opened.

#include "flyball/runtime/result.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <unistd.h>

namespace flyball {

/// `not_found`, or `unavailable` with the system's reason for a file that is there.
/// @param thing  `map file`
inline Error missing_file(const std::string& thing, const std::string& path) {
  if (access(path.c_str(), R_OK) != 0 && errno != ENOENT && errno != ENOTDIR) {
    const std::string why = std::generic_category().message(errno);
    return {ErrorCode::unavailable, "cannot read " + thing + " \"" + path + "\": " + why};
  }
  return {ErrorCode::not_found, "no " + thing + " \"" + path + "\""};
}

}  // namespace flyball
