// SPDX-License-Identifier: BSD-3-Clause
#include "lua_policy.h"

#ifndef FLYBALL_HAS_LUA

namespace flyball {

Result<std::unique_ptr<Policy>> open_lua_policy(const std::string& path, std::uint64_t /*seed*/) {
  return Error{ErrorCode::unavailable,
               path +
                   ": this program or library has no Lua; the C library never has, and others were "
                   "built without liblua5.4-dev: install it, configure and build again"};
}

}  // namespace flyball

#else

#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/policy_period.h"
#include "flyball/runtime/observation_fields.h"

#include "lua_lists.h"
#include "lua_sandbox.h"
#include "lua_values.h"
#include <array>
#include <limits>
#include <utility>

extern "C" {
#include <lauxlib.h>
#include <lua.h>
}

namespace flyball {
namespace {

constexpr const char* seen_key = "flyball.seen";
constexpr std::array<Reason, 6> reasons{Reason::fixed,  Reason::density, Reason::deadline,
                                        Reason::energy, Reason::load,    Reason::fallback};

// Everything below that takes a lua_State may be left by longjmp: no destructors in it.
void fill_seen(lua_State* state, const Observation& seen) {
  lua_getfield(state, LUA_REGISTRYINDEX, seen_key);
  for (const ObservationField& field : observation_fields()) {
    set_number(state, field.name, field.get(seen));
  }
  lua_pushstring(state, to_string(seen.phase));
  lua_setfield(state, -2, "phase");
  set_number(state, "now_s", to_seconds(seen.now));
}

/// Raises an error that names where `decide` begins.
void blame_decide(lua_State* state, const char* what, const char* name) {
  LuaSandbox::push_global(state, "decide");
  lua_Debug where{};
  lua_getinfo(state, ">S", &where);
  luaL_error(state, "%s:%d: decide %s \"%s\"", static_cast<const char*>(where.short_src),
             where.linedefined, what, name);
}

/// The reason that decide returned as its second value.
Reason read_reason(lua_State* state, int at) {
  if (lua_isnil(state, at)) {
    return Reason::fixed;
  }
  const char* text = lua_type(state, at) == LUA_TSTRING ? lua_tostring(state, at) : "";
  for (const Reason reason : reasons) {
    if (to_string(reason) == text) {
      return reason;
    }
  }
  blame_decide(state,
               "gives a reason that there is none of: fixed, density, deadline, energy, "
               "load, fallback; it is",
               luaL_typename(state, at)[0] == 's' ? text : luaL_typename(state, at));
  return Reason::fixed;
}

/// The wishes in the order of the knobs: a table has no order of its own.
void read_wishes(lua_State* state, int table, const KnobSettings& knobs, Decision* wished) {
  std::size_t found = 0;
  for (const KnobSpec& spec : knobs.specs()) {
    const int type = lua_getfield(state, table, spec.name.c_str());
    if (type == LUA_TNUMBER) {
      wished->set(spec.name, lua_tonumber(state, -1));
    } else if (type != LUA_TNIL) {
      blame_decide(state, "gives no number for", spec.name.c_str());
    }
    found += type == LUA_TNUMBER ? 1 : 0;
    lua_pop(state, 1);
  }
  const char* unknown = nullptr;  // The first by alphabet: again, the table has no order.
  std::size_t all = 0;
  for (lua_pushnil(state); lua_next(state, table) != 0; lua_pop(state, 1)) {
    ++all;
    if (lua_type(state, -2) != LUA_TSTRING) {
      blame_decide(state, "returns a table with a key that is no knob's name but a",
                   luaL_typename(state, -2));
    }
    const char* name = lua_tostring(state, -2);
    if (knobs.spec(name) == nullptr &&
        (unknown == nullptr || std::string_view{name} < std::string_view{unknown})) {
      unknown = name;
    }
  }
  if (all > found && unknown != nullptr) {
    blame_decide(state, "names a knob that does not exist:", unknown);
  }
}

class LuaPolicy final : public Policy, public ChoosesPeriod, public HostsCode {
 public:
  LuaPolicy(std::string path, std::uint64_t seed) : sandbox_{std::move(path), seed} {}

  Status load() {
    if (Status loaded = sandbox_.load(); !loaded) {
      return loaded;
    }
    return sandbox_.run(sandbox_.limits().load_instructions, [this](lua_State* state) {
      LuaSandbox::push_global(state, "decide");
      if (!lua_isfunction(state, -1)) {
        luaL_error(state, "there is no function decide(seen)");
      }
      read_period(state);
      lua_settop(state, 0);
      read_parameters(state);
      lua_newtable(state);
      lua_setfield(state, LUA_REGISTRYINDEX, seen_key);
    });
  }

  [[nodiscard]] std::vector<ParameterSpec> parameters() const override { return specs_; }
  [[nodiscard]] std::optional<Duration> period() const override { return period_; }
  [[nodiscard]] std::string_view trouble() const noexcept override { return trouble_; }
  [[nodiscard]] std::string_view remark() const noexcept override { return sandbox_.logged(); }

  Status start(const Parameters& given,
               const KnobSettings& knobs,
               const BoardModel& board) override {
    knobs_ = knobs;
    sandbox_.restart_random();
    return sandbox_.run(sandbox_.limits().load_instructions,
                        [this, &given, &board](lua_State* state) {
                          LuaSandbox::push_global(state, "start");
                          if (lua_isnil(state, -1)) {
                            return;
                          }
                          push_parameters(state, given);
                          push_knobs(state);
                          push_board(state, board);
                          lua_call(state, 3, 0);
                        });
  }

  [[nodiscard]] Decision decide(const Observation& seen) noexcept override {
    trouble_.clear();
    Decision wished;
    const Status done =
        sandbox_.run(sandbox_.limits().call_instructions, [this, &seen, &wished](lua_State* state) {
          LuaSandbox::push_global(state, "decide");
          fill_seen(state, seen);
          lua_call(state, 1, 2);
          if (!lua_istable(state, 1)) {
            blame_decide(state, "must return a table of wishes, this is a",
                         luaL_typename(state, 1));
          }
          wished.reason = read_reason(state, 2);
          read_wishes(state, 1, knobs_, &wished);
        });
    if (!done) {
      trouble_ = done.error().message;
      return {};
    }
    return wished;
  }

 private:
  void push_knobs(lua_State* state) const {
    lua_newtable(state);
    for (const KnobSpec& spec : knobs_.specs()) {
      push_knob(state, spec, knobs_.value(spec.name));
      lua_setfield(state, -2, spec.name.c_str());
    }
  }

  void read_period(lua_State* state) {
    LuaSandbox::push_global(state, "period_s");
    if (lua_isnil(state, -1)) {
      return;
    }
    if (lua_type(state, -1) != LUA_TNUMBER) {
      luaL_error(state, "period_s must be a number of seconds, this is a %s",
                 luaL_typename(state, -1));
    }
    const double period_s = lua_tonumber(state, -1);
    if (const auto fault = fault_of_period(period_s); fault[0] != '\0') {
      luaL_error(state, "%s", fault.data());
    }
    period_ = from_seconds(period_s);
  }

  void read_parameters(lua_State* state) {
    LuaSandbox::push_global(state, "parameters");
    if (!lua_isnil(state, -1) && !lua_istable(state, -1)) {
      luaL_error(state, "parameters must be a table, this is a %s", luaL_typename(state, -1));
    }
    const auto count = lua_isnil(state, -1) ? 0 : length_of_list(state, -1);
    constexpr int most = 100;
    if (count > most) {
      luaL_error(state, "parameters has more than %d", most);
    }
    for (int i = 1; i <= static_cast<int>(count); ++i) {
      if (lua_rawgeti(state, -1, i) != LUA_TTABLE) {
        luaL_error(state, "parameters[%d] must be a table", i);
      }
      read_parameter(state, i);
      lua_pop(state, 1);
    }
    lua_pop(state, 1);
  }

  /// From the table at the top.
  void read_parameter(lua_State* state, int place) {
    const char* name = text_field(state, "name");
    const char* description = text_field(state, "description");
    if (*name == '\0') {
      luaL_error(state, "parameters[%d] has no name", place);
    }
    constexpr double unbounded = std::numeric_limits<double>::max();
    const double min = number_field(state, "min", -unbounded);
    const double max = number_field(state, "max", unbounded);
    const double otherwise = number_field(state, "default", min == -unbounded ? 0.0 : min);
    lua_getfield(state, -1, "required");
    const bool required = lua_toboolean(state, -1) != 0;
    lua_pop(state, 1);
    for (const ParameterSpec& other : specs_) {
      if (other.name == name) {
        luaL_error(state, "parameters has \"%s\" twice", name);
      }
    }
    // The last thing, when Lua can raise no error any more.
    specs_.push_back({name, otherwise, min, max, description, {}, required});
  }

  LuaSandbox sandbox_;
  KnobSettings knobs_{};
  std::vector<ParameterSpec> specs_{};
  std::optional<Duration> period_{};
  std::string trouble_{};
};

}  // namespace

Result<std::unique_ptr<Policy>> open_lua_policy(const std::string& path, std::uint64_t seed) {
  auto policy = std::make_unique<LuaPolicy>(path, seed);
  if (const Status loaded = policy->load(); !loaded) {
    return loaded.error();
  }
  return std::unique_ptr<Policy>{std::move(policy)};
}

}  // namespace flyball

#endif
