// SPDX-License-Identifier: BSD-3-Clause
#ifdef FLYBALL_HAS_LUA
#include "scripts/lua_sandbox.h"

#include "scratch_folder.h"

extern "C" {
#include <lua.h>
}

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct Ran {
  Status status;
  std::string logged;
};

/// Runs a script that logs its result.
Ran ran(const std::string& script, std::uint64_t seed = 1) {
  const ScratchFolder scratch;
  LuaSandbox sandbox{scratch.file("mine.lua", script), seed};
  Status status = sandbox.load();
  return {std::move(status), sandbox.logged()};
}

std::string error_of(const std::string& script) {
  const Ran result = ran(script);
  return result.status.ok() ? "" : result.status.error().message;
}

std::string logged_by(const std::string& script) {
  const Ran result = ran(script);
  EXPECT_TRUE(result.status.ok()) << result.status.error().message;
  return result.logged;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(LuaSandbox, runs_what_a_policy_needs) {
  EXPECT_EQ("12 abc 3 2.0", logged_by("local t = {1, 2}\n"
                                      "table.insert(t, 9)\n"
                                      "print(math.max(3, 12), ('ABC'):lower(), #t, math.sqrt(4))"));
}

TEST(LuaSandbox, reads_a_script_that_an_editor_began_with_a_byte_order_mark) {
  EXPECT_EQ("7", logged_by("\xef\xbb\xbfprint(7)"));
  EXPECT_TRUE(contains(error_of("\xef\xbb\xbf\nerror('no')"), "mine.lua:2:"));
}

TEST(LuaSandbox, reads_a_script_whose_first_line_is_for_the_shell) {
  EXPECT_EQ("7", logged_by("#!/usr/bin/env lua\nprint(7)"));
  EXPECT_TRUE(contains(error_of("#!/usr/bin/env lua\nerror('no')"), "mine.lua:2:"));
}

TEST(LuaSandbox, has_no_way_out) {
  for (const char* name : {"os",           "io",          "debug",          "load",
                           "loadfile",     "dofile",      "require",        "package",
                           "coroutine",    "pcall",       "xpcall",         "setmetatable",
                           "getmetatable", "rawset",      "next",           "collectgarbage",
                           "_G",           "string.find", "string.rep",     "string.dump",
                           "string.gsub",  "table.move",  "math.randomseed"}) {
    EXPECT_EQ("nil", logged_by(std::string{"log(type("} + name + "))")) << name;
  }
  EXPECT_EQ("nil nil", logged_by("log(('x').find, ('x').rep)")) << "nor through a text";
}

TEST(LuaSandbox, names_file_and_line_of_an_error) {
  EXPECT_TRUE(contains(error_of("local a = 1\nlocal b = a.b.c\n"), "mine.lua:2:"));
  EXPECT_TRUE(contains(error_of("x = = 1"), "mine.lua:1:"));
  EXPECT_TRUE(contains(error_of("\n\nerror('enough')"), "mine.lua:3: enough"));
  EXPECT_TRUE(contains(error_of("error({})"), "mine.lua: raised a table instead of a text"));
  EXPECT_TRUE(contains(error_of("os.exit(1)"), "mine.lua:1: attempt to index a nil value"));
  EXPECT_TRUE(contains(error_of("error('without place', 0)"), "mine.lua: without place"));
}

TEST(LuaSandbox, refuses_byte_code) {
  EXPECT_TRUE(contains(error_of("\x1bLua"), "attempt to load a binary chunk"));
}

TEST(LuaSandbox, ends_a_loop_that_does_not) {
  EXPECT_TRUE(contains(error_of("local i = 0\nwhile true do\n  i = i + 1\nend"), "mine.lua:3:"));
  EXPECT_TRUE(contains(error_of("while true do end"), "its budget of instructions is used up"));
  EXPECT_TRUE(contains(error_of("local function f() return f() end f()"), "budget"));
  EXPECT_TRUE(contains(error_of("local function f() return 1 + f() end f()"), "calls itself too"));
}

TEST(LuaSandbox, ends_what_takes_all_memory) {
  const std::string kept = error_of("local t = {}\nfor i = 1, 1e9 do\n  t[i] = i .. 'x'\nend");
  EXPECT_TRUE(contains(kept, "mine.lua:3: takes more than 4 MiB")) << kept;
  const std::string copied = error_of(
      "local t = {}\nfor i = 1, 1000 do t[i] = i end\nlocal u\n"
      "for i = 1, 1e9 do u = {table.unpack(t)} end");
  EXPECT_TRUE(contains(copied, "takes more than 16 MiB in one call")) << copied;
  EXPECT_NE("", error_of("local s = 'x'\nwhile true do s = s .. s end"));
}

TEST(LuaSandbox, goes_through_a_table_in_one_order_only) {
  const std::string script =
      "local t = {zeta = 1, alpha = 2, [3] = 'c', [1] = 'a', [2.5] = 'b', beta = 3}\n"
      "for key, value in pairs(t) do log(key, value) end";
  EXPECT_EQ("1 a; 2.5 b; 3 c; alpha 2; beta 3; zeta 1", logged_by(script));
  EXPECT_TRUE(contains(error_of("for k in pairs({[{}] = 1}) do end"),
                       "mine.lua:1: pairs: a key that is a table has no order"));
}

TEST(LuaSandbox, a_key_that_is_cleared_on_the_way_is_left_out) {
  EXPECT_EQ("a; c", logged_by("local t = {a = 1, b = 2, c = 3}\n"
                              "for key in pairs(t) do t.b = nil log(key) end"));
}

TEST(LuaSandbox, draws_from_a_seeded_stream) {
  const std::string script = "log(math.random(), math.random(6), math.random(10, 20))";
  EXPECT_EQ(ran(script, 3).logged, ran(script, 3).logged);
  EXPECT_NE(ran(script, 3).logged, ran(script, 4).logged);
  EXPECT_EQ("", error_of("for i = 1, 1000 do\n"
                         "  local d = math.random(6)\n"
                         "  assert(d >= 1 and d <= 6 and math.type(d) == 'integer')\n"
                         "  local x = math.random()\n"
                         "  assert(x >= 0 and x < 1)\n"
                         "end"));
  EXPECT_TRUE(contains(error_of("math.random(3, 2)"), "interval is empty"));
}

TEST(LuaSandbox, shows_no_address) {
  EXPECT_EQ("table function", logged_by("log({}, log)"));
  EXPECT_EQ("table", logged_by("log(tostring({}))"));
  EXPECT_TRUE(contains(error_of("log(string.format('%s', {}))"), "mine.lua:1:"));
  EXPECT_TRUE(contains(error_of("log(string.format('%p', 'x'))"), "%p is an address"));
  EXPECT_EQ("1.50 x", logged_by("log(string.format('%.2f %s', 1.5, 'x'))"));
}

TEST(LuaSandbox, functions_that_do_not_count_take_short_lists_only) {
  const std::string script = "local t = {}\nfor i = 1, 2000 do t[i] = i end\ntable.sort(t)";
  EXPECT_TRUE(contains(error_of(script), "mine.lua:3:"));
  EXPECT_EQ("1 2 3", logged_by("local t = {3, 1, 2} table.sort(t) log(table.unpack(t))"));
}

TEST(LuaSandbox, has_lists_as_lua_has_them) {
  EXPECT_EQ("1 a; 2 b; 3 c", logged_by("local t = {'b'} table.insert(t, 'c')\n"
                                       "table.insert(t, 1, 'a')\n"
                                       "for i, v in ipairs(t) do log(i, v) end"));
  EXPECT_EQ("a c nil b; 1 0", logged_by("local t = {'a', 'b', 'c'}\n"
                                        "local gone = table.remove(t, 2)\n"
                                        "log(t[1], t[2], t[3], gone)\n"
                                        "table.remove(t) log(#t, #{})\n"));
  EXPECT_EQ("1-2.5-x 2.5 12", logged_by("local t = {1, 2.5, 'x'}\n"
                                        "log(table.concat(t, '-'), table.concat(t, '', 2, 2),\n"
                                        "    table.concat({1, 2}))"));
  EXPECT_EQ("2 3 nil", logged_by("log(table.unpack({1, 2, 3}, 2, 4))"));
  EXPECT_TRUE(contains(error_of("table.insert({}, 3, 1)"), "position out of bounds"));
  EXPECT_TRUE(contains(error_of("table.concat({{}})"), "invalid value (at index 1)"));
}

TEST(LuaSandbox, sorts_and_keeps_the_order_of_equals) {
  EXPECT_EQ("5 4 3 2 1", logged_by("local t = {3, 1, 5, 2, 4}\n"
                                   "table.sort(t, function(a, b) return a > b end)\n"
                                   "log(table.unpack(t))"));
  EXPECT_EQ("b d a c", logged_by("local t = {{1, 'a'}, {0, 'b'}, {1, 'c'}, {0, 'd'}}\n"
                                 "table.sort(t, function(a, b) return a[1] < b[1] end)\n"
                                 "log(t[1][2], t[2][2], t[3][2], t[4][2])"));
  EXPECT_EQ("", error_of("local t = {} for i = 1, 1000 do t[i] = math.random(500) end\n"
                         "table.sort(t)\n"
                         "for i = 2, 1000 do assert(t[i - 1] <= t[i]) end"));
  EXPECT_TRUE(contains(error_of("table.sort({1, 'a'})"), "attempt to compare"));
}

TEST(LuaSandbox, has_the_length_operator_with_luas_precedence) {
  EXPECT_EQ("3 4 7 -3 1 true 8", logged_by("local t = {1, 2, {7, 8}}\n"
                                           "log(#t, #t + 1, 2 * #t + 1, -#t, #'x',\n"
                                           "    not #t == false, 2 ^ #t // 1 | 0)"));
  EXPECT_TRUE(
      contains(error_of("local n = #nil"), "mine.lua:1: attempt to get the length of a nil"));
  EXPECT_TRUE(contains(error_of("local n = true ^ 2"), "arithmetic on a boolean value"));
}

TEST(LuaSandbox, each_run_has_a_budget_of_its_own) {
  const ScratchFolder scratch;
  LuaSandbox sandbox{scratch.file("mine.lua", "function spin(n) for i = 1, n do end end"), 1};
  ASSERT_TRUE(sandbox.load().ok());
  const auto spin = [&sandbox](double n) {
    return sandbox.run(200'000, [n](lua_State* state) {
      LuaSandbox::push_global(state, "spin");
      lua_pushnumber(state, n);
      lua_call(state, 1, 0);
    });
  };
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(spin(100'000).ok());
  }
  EXPECT_FALSE(spin(1'000'000).ok());
  EXPECT_TRUE(spin(100'000).ok());
}

}  // namespace
}  // namespace flyball
#endif
