// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Every kernel, policy, world and workload that a scenario may name.

#include "flyball/runtime/registry.h"

#include <functional>

namespace flyball {

/// Every kernel, policy, world and workload compiled in, and what was added.
[[nodiscard]] const Registry& all_plugins();
/// Kernels, policies, worlds and workloads of the caller's own; scenarios ask for them by name.
/// Before the first flight, from one thread.
///
/// @param add  A `FLYBALL_PLUGIN` function, or one that calls several. A name that is taken is a
///             programming error, as it is in the tree.
void add_plugins(const std::function<void(Registry&)>& add);

}  // namespace flyball
