// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a script's text becomes before Lua reads it.

#include "flyball/runtime/result.h"

#include <string>

namespace flyball {

/// Replaces each length operator `#` by `false^`, which binds as `#` does and calls the `__pow`
/// that lua_lists.h gives to booleans. The reason: `#` of a list with holes depends on the seed of
/// Lua's hashes, which Lua takes from the clock and from addresses, so that two runs would differ.
/// A byte order mark at the beginning, which some editors write, is left out, and so is a first
/// line that begins with `#`, as `#!/usr/bin/lua` does: Lua leaves them out of the files that it
/// reads itself.
/// @error `invalid_input` with the line of a text with a zero byte: Lua compares what lies between
///        two zero bytes one at a time, which takes a hundred times as long as other texts.
[[nodiscard]] Result<std::string> prepared_script(const std::string& text);

}  // namespace flyball
