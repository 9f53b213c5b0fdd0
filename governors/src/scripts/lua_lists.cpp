// SPDX-License-Identifier: BSD-3-Clause
// tested-in: lua_sandbox
#ifdef FLYBALL_HAS_LUA
#include "lua_lists.h"

#include "lua_sandbox.h"
#include <algorithm>
#include <utility>

extern "C" {
#include <lauxlib.h>
#include <lua.h>
}

// Lua leaves a function by longjmp when something fails: nothing here may need a destructor.
namespace flyball {
namespace {

constexpr lua_Integer longest_list = 1000;

// What one element costs, in instructions of some 5 ns each: measured on one core at 3 GHz.
constexpr lua_Integer cost_of_move = 4;
constexpr lua_Integer cost_of_comparison = 2;
constexpr lua_Integer cost_of_text = 50;

bool is_there(lua_State* state, int index, lua_Integer place) {
  const bool is = lua_rawgeti(state, index, place) != LUA_TNIL;
  lua_pop(state, 1);
  return is;
}

/// The length of the list that is the first argument.
lua_Integer short_list(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  const lua_Integer length = length_of_list(state, 1);
  luaL_argcheck(state, length <= longest_list, 1, "longer than 1000");
  return length;
}

/// false ^ x
int length(lua_State* state) {
  if (lua_type(state, 1) != LUA_TBOOLEAN || lua_toboolean(state, 1) != 0) {
    return luaL_error(state, "attempt to perform arithmetic on a %s value",
                      luaL_typename(state, lua_type(state, 1) == LUA_TNUMBER ? 2 : 1));
  }
  switch (lua_type(state, 2)) {
    case LUA_TSTRING:
      lua_pushinteger(state, static_cast<lua_Integer>(lua_rawlen(state, 2)));
      return 1;
    case LUA_TTABLE:
      LuaSandbox::charge(state, cost_of_move);
      lua_pushinteger(state, length_of_list(state, 2));
      return 1;
    default:
      return luaL_error(state, "attempt to get the length of a %s value", luaL_typename(state, 2));
  }
}

void move_element(lua_State* state, lua_Integer from, lua_Integer to) {
  lua_rawgeti(state, 1, from);
  lua_rawseti(state, 1, to);
}

/// insert(list, value), insert(list, place, value)
int insert(lua_State* state) {
  const lua_Integer end = short_list(state) + 1;
  const int count = lua_gettop(state);
  if (count != 2 && count != 3) {
    return luaL_error(state, "wrong number of arguments to 'insert'");
  }
  const lua_Integer place = count == 2 ? end : luaL_checkinteger(state, 2);
  luaL_argcheck(state, 1 <= place && place <= end, 2, "position out of bounds");
  LuaSandbox::charge(state, cost_of_move * (end - place + 1));
  for (lua_Integer i = end; i > place; --i) {
    move_element(state, i - 1, i);
  }
  lua_rawseti(state, 1, place);
  return 0;
}

/// remove(list), remove(list, place)
int remove(lua_State* state) {
  const lua_Integer size = short_list(state);
  const lua_Integer place = luaL_optinteger(state, 2, size);
  luaL_argcheck(state, place == size || (1 <= place && place <= size + 1), 2,
                "position out of bounds");
  LuaSandbox::charge(state, cost_of_move * (1 + std::max<lua_Integer>(0, size - place)));
  lua_rawgeti(state, 1, place);
  for (lua_Integer i = place; i < size; ++i) {
    move_element(state, i + 1, i);
  }
  lua_pushnil(state);
  lua_rawseti(state, 1, std::max(place, size));
  return 1;
}

struct Range {
  lua_Integer first{};
  lua_Integer last{};
};

/// From two arguments, by default the whole list.
Range range_at(lua_State* state, int index) {
  const lua_Integer size = short_list(state);
  const Range range{luaL_optinteger(state, index, 1), luaL_optinteger(state, index + 1, size)};
  const bool is_empty = range.last < range.first;
  // Unsigned, because the difference of any two numbers fits there.
  const auto span = static_cast<lua_Unsigned>(range.last) - static_cast<lua_Unsigned>(range.first);
  luaL_argcheck(state, is_empty || span < static_cast<lua_Unsigned>(longest_list), index + 1,
                "more than 1000 elements");
  return is_empty ? Range{1, 0} : range;
}

/// concat(list, separator, first, last)
int concat(lua_State* state) {
  std::size_t ignored = 0;
  const char* separator = luaL_optlstring(state, 2, "", &ignored);
  const Range range = range_at(state, 3);
  LuaSandbox::charge(state, cost_of_text * (range.last - range.first + 1));
  luaL_Buffer text;
  luaL_buffinit(state, &text);
  for (lua_Integer i = range.first; i <= range.last; ++i) {
    lua_rawgeti(state, 1, i);
    if (lua_isstring(state, -1) == 0) {
      return luaL_error(state, "invalid value (at index %I) in table for 'concat'",
                        static_cast<LUAI_UACINT>(i));
    }
    luaL_addvalue(&text);
    luaL_addstring(&text, i < range.last ? separator : "");
    LuaSandbox::check_text_size(state, luaL_bufflen(&text));
    if (i == range.last) {
      break;  // The last integer has no successor.
    }
  }
  luaL_pushresult(&text);
  return 1;
}

/// unpack(list, first, last)
int unpack(lua_State* state) {
  const Range range = range_at(state, 2);
  const lua_Integer count = range.last - range.first + 1;
  LuaSandbox::charge(state, count);
  luaL_checkstack(state, static_cast<int>(count), "too many results to unpack");
  for (lua_Integer i = 0; i < count; ++i) {
    lua_rawgeti(state, 1, range.first + i);
  }
  return static_cast<int>(count);
}

/// Whether an element of the table at `index` comes before another, by the function at 2 if any.
bool is_less(lua_State* state, int index, lua_Integer one, lua_Integer other) {
  LuaSandbox::charge(state, cost_of_comparison);
  const bool by_function = !lua_isnil(state, 2);
  if (by_function) {
    lua_pushvalue(state, 2);
  }
  lua_rawgeti(state, index, one);
  lua_rawgeti(state, index, other);
  if (!by_function) {
    const bool is = lua_compare(state, -2, -1, LUA_OPLT) != 0;
    lua_pop(state, 2);
    return is;
  }
  lua_call(state, 2, 1);
  const bool is = lua_toboolean(state, -1) != 0;
  lua_pop(state, 1);
  return is;
}

/// Merges [low, middle) and [middle, high) of the table at `from` into the one at `to`.
void merge(lua_State* state, int from, int to, const Range& range, lua_Integer middle) {
  lua_Integer left = range.first;
  lua_Integer right = middle;
  for (lua_Integer i = range.first; i < range.last; ++i) {
    const bool takes_right =
        right < range.last && (left >= middle || is_less(state, from, right, left));
    lua_rawgeti(state, from, takes_right ? right++ : left++);
    lua_rawseti(state, to, i);
  }
}

/// sort(list, is_less): equal elements keep their order.
int sort(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  lua_settop(state, 2);
  if (!lua_isnil(state, 2)) {
    luaL_checktype(state, 2, LUA_TFUNCTION);
  }
  const lua_Integer end = length_of_list(state, 1) + 1;
  lua_createtable(state, static_cast<int>(end - 1), 0);
  int from = 1;
  int to = 3;
  for (lua_Integer width = 1; width < end - 1; width *= 2) {
    for (lua_Integer low = 1; low < end; low += 2 * width) {
      const Range range{low, std::min(low + 2 * width, end)};
      merge(state, from, to, range, std::min(low + width, end));
    }
    std::swap(from, to);
  }
  for (lua_Integer i = 1; from != 1 && i < end; ++i) {
    lua_rawgeti(state, from, i);
    lua_rawseti(state, 1, i);
  }
  return 0;
}

int sort_short(lua_State* state) {
  short_list(state);
  return sort(state);
}

}  // namespace

long long length_of_list(lua_State* state, int index) {
  if (!is_there(state, index, 1)) {
    return 0;
  }
  lua_Integer low = 1;  // Is there; `high` is not.
  lua_Integer high = 2;
  constexpr lua_Integer highest = lua_Integer{1} << 60;
  while (high < highest && is_there(state, index, high)) {
    low = high;
    high *= 2;
  }
  while (high - low > 1) {
    const lua_Integer middle = low + (high - low) / 2;
    (is_there(state, index, middle) ? low : high) = middle;
  }
  return low;
}

void add_length_operator(lua_State* state) {
  lua_pushboolean(state, 0);
  lua_newtable(state);
  lua_pushcfunction(state, length);
  lua_setfield(state, -2, "__pow");
  lua_setmetatable(state, -2);
  lua_pop(state, 1);
}

void push_sort(lua_State* state) {
  lua_pushcfunction(state, sort);
}

void set_list_functions(lua_State* state) {
  static const luaL_Reg functions[] = {{"concat", concat}, {"insert", insert},
                                       {"remove", remove}, {"sort", sort_short},
                                       {"unpack", unpack}, {nullptr, nullptr}};
  luaL_setfuncs(state, functions, 0);
}

}  // namespace flyball
#endif
