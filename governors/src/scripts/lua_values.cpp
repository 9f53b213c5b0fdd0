// SPDX-License-Identifier: BSD-3-Clause
// tested-in: lua_policy
#ifdef FLYBALL_HAS_LUA
#include "lua_values.h"

#include <string>
#include <variant>

extern "C" {
#include <lauxlib.h>
#include <lua.h>
}

// Lua leaves a function by longjmp when something fails: nothing here may need a destructor.
namespace flyball {

double number_field(lua_State* state, const char* name, double otherwise) {
  const int type = lua_getfield(state, -1, name);
  if (type != LUA_TNUMBER && type != LUA_TNIL) {
    luaL_error(state, "%s must be a number, this is a %s", name, lua_typename(state, type));
  }
  const double value = type == LUA_TNIL ? otherwise : lua_tonumber(state, -1);
  lua_pop(state, 1);
  return value;
}

const char* text_field(lua_State* state, const char* name) {
  const int type = lua_getfield(state, -1, name);
  if (type != LUA_TSTRING && type != LUA_TNIL) {
    luaL_error(state, "%s must be a text, this is a %s", name, lua_typename(state, type));
  }
  const char* text = type == LUA_TNIL ? "" : lua_tostring(state, -1);
  lua_pop(state, 1);
  return text;
}

void set_number(lua_State* state, const char* name, double value) {
  lua_pushnumber(state, value);
  lua_setfield(state, -2, name);
}

void push_knob(lua_State* state, const KnobSpec& spec, double value) {
  lua_createtable(state, 0, 6);
  lua_pushlstring(state, spec.unit.data(), spec.unit.size());
  lua_setfield(state, -2, "unit");
  lua_createtable(state, static_cast<int>(spec.legal.size()), 0);
  for (std::size_t i = 0; i < spec.legal.size(); ++i) {
    lua_pushnumber(state, spec.legal[i]);
    lua_rawseti(state, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_setfield(state, -2, "legal");
  set_number(state, "min", spec.min);
  set_number(state, "max", spec.max);
  set_number(state, "default", spec.fallback);
  set_number(state, "value", value);
}

void push_parameters(lua_State* state, const Parameters& given) {
  lua_newtable(state);
  for (const auto& entry : given.values()) {
    if (const double* number = std::get_if<double>(&entry.second)) {
      lua_pushnumber(state, *number);
    } else {
      const auto& text = std::get<std::string>(entry.second);
      lua_pushlstring(state, text.data(), text.size());
    }
    lua_setfield(state, -2, entry.first.c_str());
  }
}

}  // namespace flyball
#endif
