// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Weights of networks, which the program does not bring along: tests look where a developer may
/// have put them, and are skipped otherwise.

#include "flyball/runtime/result.h"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace flyball {

/// From `$FLYBALL_MODELS`, which ctest sets to ../shared/models beside the checkout unless somebody
/// else has.
inline Result<std::string> find_test_model(const std::string& file) {
  namespace fs = std::filesystem;
  const char* given = std::getenv("FLYBALL_MODELS");  // NOLINT(concurrency-mt-unsafe)
  const fs::path path = fs::path{given != nullptr ? given : ""} / file;
  if (given == nullptr || !fs::is_regular_file(path)) {
    return Error{ErrorCode::not_found, "no " + file + " in $FLYBALL_MODELS"};
  }
  return path.string();
}

}  // namespace flyball
