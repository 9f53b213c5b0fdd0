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
  /// That one call may allocate in all, freed or not: a short program can copy a long list often.
  std::size_t call_bytes{16U << 20U};
  /// Of one text. Lua compares, converts and hashes a text in one instruction.
  std::size_t text_bytes{512};
  /// Of Lua's stack. One instruction copies all arguments of a call.
  std::size_t stack_bytes{32U << 10U};
  std::size_t script_bytes{256U << 10U};
};

/// What scripts have: `assert error ipairs select tonumber tostring type`; `math`; `string.byte
/// char format len lower reverse sub upper`; `table.concat insert remove sort unpack` of lists up
/// to 1000 long; `log`, which is also `print`. What is different: `pairs` goes through numbers,
/// then texts, ascending; `#` is the number of elements before the first hole that a search by
/// halves finds; `math.random` draws from the host's stream; `tostring` of a table is "table",
/// because its address would be another one in each run; functions are paid for from the budget by
/// the bytes and elements that they touch. What is not there: os, io, debug, load, require,
/// coroutines, metatables, arithmetic with texts, pcall (it would swallow the end of the budget),
/// patterns (they can take for ever without counting).
class LuaSandbox {
 public:
  LuaSandbox(std::string path, std::uint64_t seed);
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
  /// Takes instructions from the budget of the call. Raises the error that it is used up.
  static void charge(lua_State* state, std::int64_t instructions);
  /// Raises an error when a text is longer than allowed.
  static void check_text_size(lua_State* state, std::size_t size);
  /// What it has logged since the last `run` began.
  [[nodiscard]] const std::string& logged() const { return logged_; }
  void restart_random() { random_ = RandomStream{seed_, "policy"}; }
  [[nodiscard]] const LuaLimits& limits() const { return limits_; }

 private:
  enum class Refused : std::uint8_t { nothing, memory, call_bytes, text };
  struct Block {
    const void* place{};
    std::size_t bytes{};
  };
  using Erased = void (*)(lua_State*, const void*);
  Status run_erased(std::int64_t instructions, Erased call, const void* body);
  Status compile_and_run(const std::string& text);
  [[nodiscard]] std::string reason_of_failure(int code) const;
  [[nodiscard]] std::string refusal() const;
  [[nodiscard]] Refused refused(const void* old, std::size_t old_size, std::size_t size);
  static void* allocate(void* self, void* old, std::size_t old_size, std::size_t size);
  static LuaSandbox& of(lua_State* state);
  static void count(lua_State* state, lua_Debug* where);

  std::string path_;
  std::uint64_t seed_;
  LuaLimits limits_{};
  RandomStream random_;
  lua_State* state_{};
  std::size_t used_bytes_{};
  std::size_t call_bytes_{};
  std::int64_t instructions_left_{};
  Block stack_{};
  Block last_{};  ///< The newest.
  int blocks_{};
  Refused refused_{};  ///< Why the last block was.
  int last_line_{};
  std::string logged_{};
};

}  // namespace flyball
