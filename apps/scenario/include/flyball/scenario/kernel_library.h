// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Kernels, worlds and workloads that somebody brings in a shared library, `libmine.so` with a
/// FLYBALL_PLUGIN(mine), built against these headers in this version. Other than a policy's library
/// it runs inside this process: whoever loads it trusts its author with all that they may do
/// themselves, and a fault in it ends the program.

#include "flyball/runtime/result.h"

#include <string>
#include <vector>

namespace flyball {

/// From now on scenarios may name what the library adds. One that is loaded already is loaded.
/// Before the first flight, from one thread; it stays until the program ends.
///
/// @error `not_found`; `invalid_input` where it is no such library, or brings a name that is taken:
///        then nothing is added.
[[nodiscard]] Status load_kernels(const std::string& path);

/// The files that were loaded, in this order: a mission consists of them, too.
[[nodiscard]] const std::vector<std::string>& loaded_kernel_libraries();

}  // namespace flyball
