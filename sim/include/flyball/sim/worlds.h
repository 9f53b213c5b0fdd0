// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Every world generator compiled into this build.

namespace flyball {
class Registry;
void register_worlds(Registry& registry);
}  // namespace flyball
