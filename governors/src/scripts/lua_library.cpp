// SPDX-License-Identifier: BSD-3-Clause
// tested-in: lua_sandbox
#ifdef FLYBALL_HAS_LUA
#include "lua_library.h"

#include "lua_lists.h"
#include "lua_sandbox.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

extern "C" {
#include <lauxlib.h>
#include <lualib.h>
}

// Lua leaves a function by longjmp when something fails: nothing here may need a destructor.
namespace flyball {
namespace {

// A table's own order depends on addresses and on a seed that Lua takes from the clock.
constexpr const char* prelude = R"lua(
local next, sort, type, error = ...
return function(t)
  if type(t) ~= "table" then
    error("pairs: a table is needed, this is a " .. type(t), 2)
  end
  local numbers, texts, other = {}, {}, nil
  for key in next, t do
    local kind = type(key)
    if kind == "number" then
      numbers[#numbers + 1] = key
    elseif kind == "string" then
      texts[#texts + 1] = key
    else
      error("pairs: a key that is a " .. kind .. " has no order that would be the same in each run", 2)
    end
  end
  sort(numbers)
  sort(texts)
  local i, n = 0, #numbers
  return function()
    local key, value
    repeat
      i = i + 1
      if i <= n then key = numbers[i] else key = texts[i - n] end
      if key ~= nil then value = t[key] end
    until key == nil or value ~= nil
    return key, value
  end
end
)lua";

// What the functions of texts cost, in instructions of some 5 ns: measured on one core at 3 GHz.
constexpr lua_Integer cost_of_call = 10;
constexpr lua_Integer cost_of_number = 50;          ///< From or to a text.
constexpr lua_Integer cost_of_formatted_byte = 16;  ///< "%.99f" of 1e308 takes 31 us.

const LuaHost& host_of(lua_State* state) {
  return *static_cast<const LuaHost*>(lua_touserdata(state, lua_upvalueindex(1)));
}

/// Bytes of the texts from `first` on, and one for each value.
lua_Integer size_of_values(lua_State* state, int first) {
  lua_Integer size = 0;
  for (int i = first; i <= lua_gettop(state); ++i) {
    const bool is_text = lua_type(state, i) == LUA_TSTRING;
    size += 1 + (is_text ? static_cast<lua_Integer>(lua_rawlen(state, i)) : 0);
  }
  return size;
}

/// tostring, without addresses.
int text_of(lua_State* state) {
  luaL_checkany(state, 1);
  LuaSandbox::charge(state, cost_of_number);
  const int type = lua_type(state, 1);
  if (type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TBOOLEAN || type == LUA_TNIL) {
    luaL_tolstring(state, 1, nullptr);
  } else {
    lua_pushstring(state, luaL_typename(state, 1));
  }
  return 1;
}

int log_line(lua_State* state) {
  luaL_Buffer line;
  LuaSandbox::charge(state, size_of_values(state, 1));
  const int count = lua_gettop(state);
  luaL_buffinit(state, &line);
  for (int i = 1; i <= count; ++i) {
    lua_pushcfunction(state, text_of);
    lua_pushvalue(state, i);
    lua_call(state, 1, 1);
    luaL_addvalue(&line);
    luaL_addstring(&line, i < count ? " " : "");
  }
  luaL_pushresult(&line);
  const LuaHost& host = host_of(state);
  host.log(host.context, lua_tostring(state, -1));
  return 0;
}

/// math.random() in [0, 1), math.random(m) in 1..m, math.random(m, n) in m..n.
int random_number(lua_State* state) {
  const LuaHost& host = host_of(state);
  const double draw = host.uniform(host.context);
  if (lua_gettop(state) == 0) {
    lua_pushnumber(state, draw);
    return 1;
  }
  const bool both = lua_gettop(state) > 1;
  const lua_Integer low = both ? luaL_checkinteger(state, 1) : 1;
  const lua_Integer high = luaL_checkinteger(state, both ? 2 : 1);
  constexpr lua_Integer widest = 1LL << 52;
  luaL_argcheck(state, low <= high && low > -widest && high < widest, both ? 2 : 1,
                "interval is empty or too wide");
  const double span = static_cast<double>(high - low) + 1.0;
  lua_pushinteger(state, low + static_cast<lua_Integer>(std::floor(draw * span)));
  return 1;
}

/// Calls the function in the first upvalue with what is on the stack.
int call_wrapped(lua_State* state) {
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
  return lua_gettop(state);
}

/// The same, paid for by the values and bytes that go in and come out.
int call_charged(lua_State* state) {
  LuaSandbox::charge(state, cost_of_call + size_of_values(state, 1));
  const int count = call_wrapped(state);
  LuaSandbox::charge(state, size_of_values(state, 1));
  for (int i = 1; i <= count; ++i) {
    if (lua_type(state, i) == LUA_TSTRING &&
        std::memchr(lua_tostring(state, i), '\0', lua_rawlen(state, i)) != nullptr) {
      return luaL_error(state, "makes a text with a zero byte, which is not allowed here");
    }
  }
  return count;
}

/// Raises an error when a conversion of the format writes an address.
void check_format(lua_State* state) {
  const std::string_view format{luaL_checkstring(state, 1), lua_rawlen(state, 1)};
  for (std::size_t at = format.find('%'); at < format.size(); at = format.find('%', at)) {
    LuaSandbox::charge(state, cost_of_number);
    at = std::min(format.find_first_not_of("-+ #0123456789.", at + 1), format.size());
    luaL_argcheck(state, at == format.size() || format[at] != 'p', 1, "%p is an address");
    ++at;
  }
}

/// string.format without addresses.
int format_text(lua_State* state) {
  check_format(state);
  for (int i = 2; i <= lua_gettop(state); ++i) {
    const int type = lua_type(state, i);
    luaL_argcheck(state, type != LUA_TTABLE && type != LUA_TFUNCTION, i,
                  "a table or function has no text that would be the same in each run");
  }
  const int count = call_charged(state);
  LuaSandbox::charge(state, cost_of_formatted_byte * size_of_values(state, 1));
  return count;
}

/// Copies fields from the library at the top of the stack to the table below it.
void keep(lua_State* state, const char* const* names) {
  for (; *names != nullptr; ++names) {
    lua_getfield(state, -1, *names);
    lua_setfield(state, -3, *names);
  }
}

/// Replaces a function of the table at the top by `wrapper` around it.
void wrap(lua_State* state, const char* name, lua_CFunction wrapper) {
  lua_getfield(state, -1, name);
  lua_pushcclosure(state, wrapper, 1);
  lua_setfield(state, -2, name);
}

void set_host_function(lua_State* state,
                       const LuaHost* host,
                       const char* name,
                       lua_CFunction function) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): Lua only hands it back
  lua_pushlightuserdata(state, const_cast<LuaHost*>(host));
  lua_pushcclosure(state, function, 1);
  lua_setfield(state, -2, name);
}

void open(lua_State* state, const char* name, lua_CFunction library) {
  luaL_requiref(state, name, library, 0);
}

void add_base(lua_State* state, const LuaHost* host) {
  static const char* const names[] = {"assert", "error",    "ipairs", "select",
                                      "type",   "tonumber", nullptr};
  open(state, "_G", luaopen_base);
  keep(state, names);
  if (luaL_loadbufferx(state, prelude, std::strlen(prelude), "=flyball", "t") != LUA_OK) {
    lua_error(state);
  }
  lua_getfield(state, -2, "next");
  push_sort(state);
  lua_getfield(state, -4, "type");
  lua_getfield(state, -5, "error");
  lua_call(state, 4, 1);
  lua_setfield(state, -3, "pairs");
  lua_pop(state, 1);
  for (const char* name : {"assert", "select", "tonumber"}) {
    wrap(state, name, call_charged);
  }
  lua_pushcfunction(state, text_of);
  lua_setfield(state, -2, "tostring");
  set_host_function(state, host, "log", log_line);
  set_host_function(state, host, "print", log_line);
}

void add_math(lua_State* state, const LuaHost* host) {
  static const char* const names[] = {
      "abs",  "acos", "asin", "atan", "ceil",       "cos",  "deg",        "exp",  "floor",
      "fmod", "huge", "log",  "max",  "maxinteger", "min",  "mininteger", "modf", "pi",
      "rad",  "sin",  "sqrt", "tan",  "tointeger",  "type", "ult",        nullptr};
  lua_newtable(state);
  open(state, "math", luaopen_math);
  keep(state, names);
  lua_pop(state, 1);
  set_host_function(state, host, "random", random_number);
  lua_setfield(state, -2, "math");
}

void add_string(lua_State* state) {
  static const char* const names[] = {"byte",    "char", "format", "len",  "lower",
                                      "reverse", "sub",  "upper",  nullptr};
  lua_newtable(state);
  open(state, "string", luaopen_string);
  keep(state, names);
  lua_pop(state, 1);
  for (const char* const* name = names; *name != nullptr; ++name) {
    wrap(state, *name, std::strcmp(*name, "format") == 0 ? format_text : call_charged);
  }
  // The metatable of texts would reach the whole library, ("x"):find(...), and do arithmetic with
  // texts, which takes time by their length in one instruction.
  lua_pushliteral(state, "");
  lua_newtable(state);
  lua_pushvalue(state, -3);
  lua_setfield(state, -2, "__index");
  lua_setmetatable(state, -2);
  lua_pop(state, 1);
  lua_setfield(state, -2, "string");
}

void add_table(lua_State* state) {
  lua_newtable(state);
  set_list_functions(state);
  lua_setfield(state, -2, "table");
}

}  // namespace

void push_lua_globals(lua_State* state, const LuaHost* host) {
  luaL_checkstack(state, 20, nullptr);
  lua_newtable(state);
  add_base(state, host);
  add_math(state, host);
  add_string(state);
  add_table(state);
  add_length_operator(state);
}

}  // namespace flyball
#endif
