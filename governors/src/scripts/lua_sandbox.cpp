// SPDX-License-Identifier: BSD-3-Clause
#ifdef FLYBALL_HAS_LUA
#include "lua_sandbox.h"

#include "flyball/runtime/text/printable.h"

#include "lua_library.h"
#include "lua_source.h"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

extern "C" {
#include <lauxlib.h>
#include <lua.h>
}

namespace flyball {
namespace {

constexpr int look_every = 1000;  // Instructions between two looks at the budget.
constexpr const char* used_up = "its budget of instructions is used up; does this loop end?";
constexpr const char* stack_is_full = "calls itself too often, or passes too many values at once";
constexpr const char* globals_key = "flyball.globals";

/// What travels through lua_pcall.
struct Call {
  void (*invoke)(lua_State*, const void*){};
  const void* body{};
};

int invoke(lua_State* state) {
  const auto* call = static_cast<const Call*>(lua_touserdata(state, 1));
  lua_settop(state, 0);
  call->invoke(state, call->body);
  return 0;
}

}  // namespace

LuaSandbox::LuaSandbox(std::string path, std::uint64_t seed)
    : path_{std::move(path)}, seed_{seed}, random_{seed, "policy"} {}

LuaSandbox::~LuaSandbox() {
  if (state_ != nullptr) {
    lua_close(state_);
  }
}

LuaSandbox::Refused LuaSandbox::refused(const void* old, std::size_t old_size, std::size_t size) {
  // Without an old block its size is the kind of object that the new one is for.
  constexpr std::size_t header_bytes = 32;
  if (old == nullptr && old_size == LUA_TSTRING && size > limits_.text_bytes + header_bytes) {
    return Refused::text;
  }
  const std::size_t before = old == nullptr ? 0 : old_size;
  if (size <= before) {
    return Refused::nothing;  // Lua relies on it that shrinking succeeds.
  }
  call_bytes_ += size - before;
  if (call_bytes_ > limits_.call_bytes) {
    return Refused::call_bytes;
  }
  return used_bytes_ - before + size > limits_.memory_bytes ? Refused::memory : Refused::nothing;
}

void* LuaSandbox::allocate(void* self, void* old, std::size_t old_size, std::size_t size) {
  auto& sandbox = *static_cast<LuaSandbox*>(self);
  const std::size_t before = old == nullptr ? 0 : old_size;
  // To let its stack grow, Lua asks for a larger block, or for another one and then frees the
  // first.
  const bool is_stack = old != nullptr && old == sandbox.stack_.place;
  const bool is_new = old == nullptr;
  if (size == 0) {
    sandbox.stack_ = is_stack ? sandbox.last_ : sandbox.stack_;
    std::free(old);  // NOLINT(cppcoreguidelines-no-malloc): Lua's way
    sandbox.used_bytes_ -= before;
    return nullptr;
  }
  const Refused refused = sandbox.refused(old, old_size, size);
  if (refused != Refused::nothing) {
    sandbox.refused_ = refused;
    // Lua collects all garbage now and tries once more, which takes time by what is in use.
    constexpr std::size_t bytes_an_instruction = 64;
    sandbox.instructions_left_ -=
        static_cast<std::int64_t>(sandbox.used_bytes_ / bytes_an_instruction);
    return nullptr;
  }
  void* place = std::realloc(old, size);  // NOLINT(cppcoreguidelines-no-malloc)
  if (place == nullptr) {
    return nullptr;
  }
  sandbox.used_bytes_ = sandbox.used_bytes_ - before + size;
  sandbox.last_ = is_new ? Block{place, size} : sandbox.last_;
  constexpr int stack_is_block = 2;  // A new state asks for itself first.
  if (is_stack || (is_new && ++sandbox.blocks_ == stack_is_block)) {
    sandbox.stack_ = Block{place, size};
  }
  return place;
}

LuaSandbox& LuaSandbox::of(lua_State* state) {
  return **static_cast<LuaSandbox**>(lua_getextraspace(state));
}

void LuaSandbox::count(lua_State* state, lua_Debug* where) {
  auto& sandbox = of(state);
  lua_getinfo(state, "Sl", where);
  sandbox.last_line_ = where->currentline;
  sandbox.instructions_left_ -= look_every;
  const char* fault = sandbox.instructions_left_ < 0                       ? used_up
                      : sandbox.stack_.bytes > sandbox.limits_.stack_bytes ? stack_is_full
                                                                           : nullptr;
  if (fault != nullptr) {
    luaL_error(state, "%s:%d: %s", static_cast<const char*>(where->short_src), where->currentline,
               fault);
  }
}

void LuaSandbox::charge(lua_State* state, std::int64_t instructions) {
  auto& sandbox = of(state);
  sandbox.instructions_left_ -= instructions;
  if (sandbox.instructions_left_ < 0) {
    luaL_error(state, "%s", used_up);
  }
}

void LuaSandbox::check_text_size(lua_State* state, std::size_t size) {
  const std::size_t most = of(state).limits_.text_bytes;
  if (size > most) {
    luaL_error(state, "makes a text of more than %d bytes", static_cast<int>(most));
  }
}

void LuaSandbox::push_global(lua_State* state, const char* name) {
  lua_getfield(state, LUA_REGISTRYINDEX, globals_key);
  lua_getfield(state, -1, name);
  lua_remove(state, -2);
}

std::string LuaSandbox::refusal() const {
  const auto mebibytes = [](std::size_t bytes) { return std::to_string(bytes >> 20U) + " MiB"; };
  switch (refused_) {
    case Refused::text:
      return "makes a text of more than " + std::to_string(limits_.text_bytes) + " bytes";
    case Refused::call_bytes:
      return "takes more than " + mebibytes(limits_.call_bytes) + " in one call";
    case Refused::memory:
    case Refused::nothing:
      break;
  }
  return "takes more than " + mebibytes(limits_.memory_bytes);
}

std::string LuaSandbox::reason_of_failure(int code) const {
  if (code == LUA_ERRMEM) {
    const std::string line = last_line_ > 0 ? ":" + std::to_string(last_line_) : "";
    return path_ + line + ": " + refusal();
  }
  // Only a text has one already; converting another value could fail.
  if (lua_type(state_, -1) != LUA_TSTRING) {
    return path_ + ": raised a " + luaL_typename(state_, -1) + " instead of a text";
  }
  const std::string text = printable(lua_tostring(state_, -1));
  const std::string file = std::filesystem::path{path_}.filename().string();
  return text.find(file) == std::string::npos ? path_ + ": " + text : text;
}

Status LuaSandbox::run_erased(std::int64_t instructions, Erased call, const void* body) {
  Call travelling{call, body};
  logged_.clear();
  instructions_left_ = instructions;
  call_bytes_ = 0;
  refused_ = Refused::nothing;
  last_line_ = 0;
  lua_settop(state_, 0);
  lua_sethook(state_, count, LUA_MASKCOUNT, look_every);
  lua_pushcfunction(state_, invoke);
  lua_pushlightuserdata(state_, &travelling);
  const int code = lua_pcall(state_, 1, 0, 0);
  if (code != LUA_OK) {
    return Error{ErrorCode::invalid_input, reason_of_failure(code)};
  }
  return Done{};
}

Status LuaSandbox::load() {
  std::error_code failed;
  std::ifstream file{path_, std::ios::binary};
  if (!std::filesystem::is_regular_file(path_, failed) || !file) {
    return Error{ErrorCode::not_found, "no policy script " + path_};
  }
  if (const auto size = std::filesystem::file_size(path_, failed); size > limits_.script_bytes) {
    return Error{ErrorCode::invalid_input, path_ + ": has " + std::to_string(size) +
                                               " bytes, a script may have " +
                                               std::to_string(limits_.script_bytes)};
  }
  const auto text = prepared_script({std::istreambuf_iterator<char>{file}, {}});
  if (!text) {
    return Error{text.error().code, path_ + ":" + text.error().message};
  }
  state_ = lua_newstate(allocate, this);
  if (state_ == nullptr) {
    return Error{ErrorCode::failed, path_ + ": no memory for Lua"};
  }
  *static_cast<LuaSandbox**>(lua_getextraspace(state_)) = this;
  return compile_and_run(*text);
}

Status LuaSandbox::compile_and_run(const std::string& text) {
  static constexpr auto uniform = [](void* self) {
    return static_cast<LuaSandbox*>(self)->random_.uniform();
  };
  static constexpr auto log = [](void* self, const char* line) {
    std::string& logged = static_cast<LuaSandbox*>(self)->logged_;
    constexpr std::size_t longest = 400;  // A line for the record, not a place to store things.
    if (logged.size() < longest) {
      logged += (logged.empty() ? "" : "; ") + printable(line);
    }
  };
  // As Lua shows it; whole, a long one would be a text that is not allowed.
  constexpr std::size_t longest_name = 56;
  const std::string name = path_.size() <= longest_name
                               ? "@" + path_
                               : "@..." + path_.substr(path_.size() - longest_name);
  return run(limits_.load_instructions, [this, &text, &name](lua_State* state) {
    // Owned by the state, like all that uses it.
    auto* host = static_cast<LuaHost*>(lua_newuserdatauv(state, sizeof(LuaHost), 0));
    *host = LuaHost{this, uniform, log};
    lua_setfield(state, LUA_REGISTRYINDEX, "flyball.host");
    push_lua_globals(state, host);
    lua_pushvalue(state, -1);
    lua_setfield(state, LUA_REGISTRYINDEX, globals_key);
    if (luaL_loadbufferx(state, text.data(), text.size(), name.c_str(), "t") != LUA_OK) {
      lua_error(state);
    }
    lua_pushvalue(state, -2);
    lua_setupvalue(state, -2, 1);  // _ENV: the only globals that the script has.
    lua_call(state, 0, 0);
  });
}

}  // namespace flyball
#endif
