// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which Flyball this is.

#include <string>

namespace flyball {

/// `0.1.0`
[[nodiscard]] std::string version();
/// Hash over the build ids of the program and of every library that it loaded: another build, or
/// another OctoMap, has another one.
[[nodiscard]] std::string build_fingerprint();

}  // namespace flyball
