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

namespace {

void push_clock(lua_State* state, Hertz clock, const BoardModel& board) {
  lua_createtable(state, 0, 3);
  set_number(state, "hz", clock.value());
  if (board.power) {
    const double idle_w = board.power->power(clock, 0.0).value();
    set_number(state, "idle_w", idle_w);
    set_number(state, "busy_core_w", board.power->power(clock, 1.0).value() - idle_w);
  }
}

void push_heat(lua_State* state, const ThermalModel& heat) {
  lua_createtable(state, 0, 4);
  set_number(state, "ambient_c", heat.ambient_c);
  set_number(state, "resistance_k_w", heat.resistance_k_w);
  set_number(state, "time_constant_s", heat.time_constant_s);
  lua_createtable(state, static_cast<int>(heat.trips.size()), 0);
  for (std::size_t i = 0; i < heat.trips.size(); ++i) {
    lua_createtable(state, 0, 3);
    set_number(state, "at_c", heat.trips[i].at_c);
    set_number(state, "hysteresis_k", heat.trips[i].hysteresis_k);
    set_number(state, "cap_hz", heat.trips[i].cap.value());
    lua_rawseti(state, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_setfield(state, -2, "trips");
}

}  // namespace

void push_board(lua_State* state, const BoardModel& board) {
  lua_createtable(state, 0, 6);
  if (board.max_cores > 0) {
    set_number(state, "cores", board.max_cores);
  }
  if (!board.frequencies.empty()) {
    set_number(state, "switching_s", to_seconds(board.switching_time));
    lua_createtable(state, static_cast<int>(board.frequencies.size()), 0);
    for (std::size_t i = 0; i < board.frequencies.size(); ++i) {
      push_clock(state, board.frequencies[i], board);
      lua_rawseti(state, -2, static_cast<lua_Integer>(i) + 1);
    }
    lua_setfield(state, -2, "clocks");
  }
  if (board.power && board.power->idle_core_w > 0.0) {
    set_number(state, "off_core_w", board.power->off_core_power().value());
  }
  if (board.memory_contention > 0.0) {
    set_number(state, "memory_contention", board.memory_contention);
  }
  if (board.thermal) {
    push_heat(state, *board.thermal);
    lua_setfield(state, -2, "thermal");
  }
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
