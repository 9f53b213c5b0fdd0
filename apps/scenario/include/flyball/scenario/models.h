// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Weights of networks: which ones are known, and where they are searched for. None are shipped.

#include "flyball/runtime/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace flyball {

struct KnownModel {
  std::string file;  ///< `yolo-fastest-1.1.weights`
  std::uint64_t bytes{};
  std::string sha256;
  std::string source;  ///< The project that publishes it.
};

/// From the shipped list, in its order.
/// @error The list is missing or broken.
[[nodiscard]] Result<std::vector<KnownModel>> known_models();

/// The folders to search, in this order: `folder` (unless it is `shipped`), the folder that the
/// environment variable FLYBALL_MODELS names, the install's share folder.
[[nodiscard]] std::vector<std::string> model_folders(const std::string& folder);

/// Path of the first file of this name; it is the file that the list describes, byte for byte.
///
/// @error `not_found`: in none of the folders, or no file that flyball knows; `invalid_input`: the
///        first one found is another file. Says which, and what to do.
[[nodiscard]] Result<std::string> find_model(const std::string& file, const std::string& folder);

}  // namespace flyball
