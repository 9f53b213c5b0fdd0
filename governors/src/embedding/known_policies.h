// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The policies that are linked into the library. This folder stands below `policies`, so CMake
/// writes the definition: a table of all that need no further library.

namespace flyball {
class Registry;
void register_known_policies(Registry& registry);
}  // namespace flyball
