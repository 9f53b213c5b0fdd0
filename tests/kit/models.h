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

/// From `$FLYBALL_MODELS`, or ../shared/models beside the checkout.
inline Result<std::string> find_test_model(const std::string& file) {
  namespace fs = std::filesystem;
  const char* given = std::getenv("FLYBALL_MODELS");  // NOLINT(concurrency-mt-unsafe)
  const fs::path checkout = fs::path{__FILE__}.parent_path().parent_path().parent_path();
  const fs::path folder =
      given != nullptr ? fs::path{given} : checkout.parent_path() / "shared/models";
  const fs::path path = folder / file;
  if (!fs::is_regular_file(path)) {
    return Error{ErrorCode::not_found, "no model"};
  }
  return path.string();
}

}  // namespace flyball
