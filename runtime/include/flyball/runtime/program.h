// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The program that runs, as a file.

#include <string>

namespace flyball {

/// Starts this program anew: the launcher that started it with libraries of its own, which the
/// environment variable FLYBALL_PROGRAM names (apps/cli/bundle), or `/proc/self/exe`.
[[nodiscard]] std::string program_to_start();

/// The same as the file of that name, whose folder tells where shipped data lies; empty where
/// nobody knows.
[[nodiscard]] std::string program_file();

}  // namespace flyball
