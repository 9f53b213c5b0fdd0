// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The length of a text or list, and the functions of `table`. Lua's own depend on where its hashes
/// put a list with holes, its sort on the clock, and none of them counts what it does.

struct lua_State;

namespace flyball {

/// The number of elements before a hole: the same for equal tables. O(log n).
[[nodiscard]] long long length_of_list(lua_State* state, int index);
/// Makes `false^x` the length of x, see lua_source.h.
void add_length_operator(lua_State* state);
/// Sets concat, insert, remove, sort and unpack in the table at the top.
void set_list_functions(lua_State* state);
/// Pushes `sort`, for lists of any length.
void push_sort(lua_State* state);

}  // namespace flyball
