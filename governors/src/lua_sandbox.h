// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A Lua 5.4 state that cannot reach out, run for ever, fill the memory, or do one thing today and
/// another tomorrow.

#include "flyball/runtime/random.h"
#include "flyball/runtime/result.h"

#include <cstddef>
#include <cstdint>
#include <string>

struct lua_State;
struct lua_Debug;

namespace flyball {

struct LuaLimits {
  std::int64_t load_instructions{2'000'000};
  std::int64_t call_instructions{200'000};
  std::size_t memory_bytes{4U << 20U};
  /// That one call may allocate in all, freed or not: a short program can copy a long text often.
  std::size_t call_bytes{64U << 20U};
};

/// What scripts have: `assert error ipairs select tonumber tostring type`; `math`; `string.byte
/// char format len lower reverse sub upper`; `table.concat insert remove sort unpack` of lists up
/// to 1000 long; `log`, which is also `print`. What is different: `pairs` goes through numbers,
/// then texts, ascending; `math.random` draws from the host's stream; `tostring` of a table is
/// "table", because its address would be another one in each run. What is not there: os, io, debug,
/// load, require, coroutines, metatables, pcall (it would swallow the end of the budget), patterns
/// (they can take for ever without counting).
class LuaSandbox {
 public:
  LuaSandbox(std::string path, std::uint64_t seed, LuaLimits limits);
  ~LuaSandbox();
  LuaSandbox(const LuaSandbox&) = delete;
  LuaSandbox& operator=(const LuaSandbox&) = delete;

  /// Reads and runs the file.
  /// @error `not_found`; `invalid_input` with file and line.
  Status load();
  /// Runs `body(state)`, where Lua may fail anywhere: nothing in the body may need a destructor.
  /// @error One sentence with file and line.
  template <class Body>
  Status run(std::int64_t instructions, const Body& body) {
    return run_erased(
        instructions,
        [](lua_State* state, const void* erased) { (*static_cast<const Body*>(erased))(state); },
        &body);
  }
  /// Pushes a global of the script.
  static void push_global(lua_State* state, const char* name);
  /// What it has logged since the last `run` began.
  [[nodiscard]] const std::string& logged() const { return logged_; }
  void restart_random() { random_ = RandomStream{seed_, "policy"}; }
  [[nodiscard]] const LuaLimits& limits() const { return limits_; }

 private:
  using Erased = void (*)(lua_State*, const void*);
  Status run_erased(std::int64_t instructions, Erased call, const void* body);
  Status compile_and_run(const std::string& text);
  [[nodiscard]] std::string reason_of_failure(int code) const;
  static void* allocate(void* self, void* old, std::size_t old_size, std::size_t size);
  static void count(lua_State* state, lua_Debug* where);

  std::string path_;
  std::uint64_t seed_;
  LuaLimits limits_;
  RandomStream random_;
  lua_State* state_{};
  std::size_t used_bytes_{};
  std::size_t call_bytes_{};
  std::int64_t instructions_left_{};
  int last_line_{};
  std::string logged_{};
};

}  // namespace flyball
