// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The functions that a script may call.

struct lua_State;

namespace flyball {

/// Where `math.random` and `log` go.
struct LuaHost {
  void* context{};
  double (*uniform)(void* context){};  ///< In [0, 1).
  void (*log)(void* context, const char* line){};
};

/// Leaves the script's table of globals on the stack. `host` outlives the state. May raise.
void push_lua_globals(lua_State* state, const LuaHost* host);

}  // namespace flyball
