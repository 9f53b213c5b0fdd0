// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Every kernel compiled into this build.

namespace flyball {
class Registry;
void register_kernels(Registry& registry);
}  // namespace flyball
