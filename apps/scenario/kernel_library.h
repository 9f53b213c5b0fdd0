// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Shared libraries with kernels, worlds and workloads. `Plugins::with_library` says whom they
/// trust.

#include "flyball/runtime/registry.h"

#include <string>

namespace flyball {

/// Loads a library and returns what it adds, apart from all else. From one thread at a time.
/// @error `not_found`; `invalid_input` where it is no such library.
[[nodiscard]] Result<Registry> load_kernel_library(const std::string& path);

/// `invalid_input`: `library "./libmine.so" adds nothing`
[[nodiscard]] Error broken_library(const std::string& path, const std::string& what);

}  // namespace flyball
