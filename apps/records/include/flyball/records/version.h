// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which Flyball this is.

#include <string>

namespace flyball {

/// `0.1.0`
[[nodiscard]] std::string version();
/// Hash over the build ids of the program and of every library that it starts with, so that another
/// build or another OctoMap has another fingerprint. It is constant while the program runs.
[[nodiscard]] std::string build_fingerprint();

}  // namespace flyball
