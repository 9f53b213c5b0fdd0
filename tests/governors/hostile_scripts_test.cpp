// SPDX-License-Identifier: BSD-3-Clause
// test-label: fault
// compiled-alone
//
// Scripts that somebody wrote to break a mission: each ends in a sentence that names what it did.
#ifdef FLYBALL_HAS_LUA
#include "policy_start.h"
#include "scratch_folder.h"
#include "scripts/lua_policy.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct Hostile {
  std::string script;
  std::string sentence;  ///< Part of it.
};

/// What is said when it is opened, started, or asked at last.
std::string end_of(const std::string& script) {
  const ScratchFolder scratch;
  auto policy = open_lua_policy(scratch.file("mine.lua", script), 1);
  if (!policy) {
    return policy.error().message;
  }
  if (const Status started = kit::start(**policy); !started) {
    return started.error().message;
  }
  static_cast<void>((*policy)->decide({}));
  return std::string{kit::trouble(**policy)};
}

void expect_ends(const std::vector<Hostile>& scripts) {
  for (const auto& [script, sentence] : scripts) {
    const std::string said = end_of(script);
    EXPECT_NE(std::string::npos, said.find(sentence)) << script << "\n" << said;
    EXPECT_NE(std::string::npos, said.find("mine.lua")) << script << "\n" << said;
    EXPECT_EQ(std::string::npos, said.find('\n')) << said;
  }
}

/// A hostile body of `decide`.
std::string deciding(const std::string& body) {
  return "function decide(s) " + body + " return {} end";
}

/// A hostile body of the file, which may do ten times as much.
std::string loading(const std::string& body) {
  return body + " function decide() end";
}

/// A body of `decide` after a local `a` of 256 bytes and a list `t` of 1000 elements.
std::string with_long(const std::string& body) {
  return "local a, t = 'x', {} for i = 1, 8 do a = a .. a end for i = 1, 1000 do t[i] = i end\n" +
         deciding(body);
}

const std::string used_up = "its budget of instructions is used up";

TEST(HostileScripts, that_never_end_are_ended) {
  expect_ends({
      {deciding("while true do end"), used_up},
      {deciding("repeat until false"), used_up},
      {deciding("::again:: goto again"), used_up},
      {deciding("for i = 1, math.huge do end"), used_up},
      {deciding("local function f() return f() end f()"), used_up},
      {deciding("local t = {} for i = 1, 1e9 do t[i % 9] = i end"), used_up},
      {"while true do end function decide() end", used_up},
      {"function decide() end function start() while true do end end", used_up},
      {deciding("table.sort({3, 1, 2}, function() while true do end end)"), used_up},
  });
}

TEST(HostileScripts, that_hide_work_in_functions_pay_for_it) {
  expect_ends({
      {with_long("for i = 1, 20000 do tonumber(a) end"), used_up},
      {with_long("for i = 1, 20000 do tonumber(a, 36) end"), used_up},
      {with_long("for i = 1, 20000 do s = a:lower() end"), used_up},
      {with_long("for i = 1, 20000 do s = a:reverse() end"), used_up},
      {with_long("for i = 1, 20000 do s = a:sub(2) end"), used_up},
      {with_long("for i = 1, 20000 do a:byte(1, -1) end"), used_up},
      {with_long("for i = 1, 20000 do log(a) end"), used_up},
      {with_long("for i = 1, 20000 do print(i) end"), used_up},
      {with_long("for i = 1, 20000 do string.format('%.99f', 1e308) end"), used_up},
      {with_long("for i = 1, 20000 do string.format('%.99g%.99g%.99g', 5e-324, 1, 2) end"),
       used_up},
      {with_long("for i = 1, 20000 do table.insert(t, 1, table.remove(t)) end"), used_up},
      {with_long("for i = 1, 20000 do table.remove(t, 1) table.insert(t, 1) end"), used_up},
      {with_long("for i = 1, 20000 do table.sort(t) end"), used_up},
      {with_long("for i = 1, 20000 do pairs(t) end"), used_up},
      {with_long("for i = 1, 20000 do select('#', table.unpack(t)) end"), used_up},
      {with_long("for i = 1, 20000 do table.concat(t, '', 1, 100) end"), used_up},
      {with_long("for i = 1, 90000 do local n = #t end"), used_up},
  });
}

TEST(HostileScripts, that_take_all_memory_are_refused_it) {
  expect_ends({
      {loading("local t = {} for i = 1, 1e9 do t[i] = {} end"), "takes more than 4 MiB"},
      {loading("local t = {} for i = 1, 1e9 do t['k' .. i] = 1 end"), "takes more than 4 MiB"},
      {loading("local f for i = 1, 1e9 do local g = f f = function() return g end end"),
       "takes more than 4 MiB"},
      {loading("local t = {} for i = 1, 1000 do t[i] = i end "
               "for i = 1, 1e9 do local u = {table.unpack(t)} end"),
       "takes more than 16 MiB"},
      {deciding("local s = 'x' while true do s = s .. s end"), "a text of more than 512 bytes"},
      {with_long("s = a .. a .. a"), "a text of more than 512 bytes"},
      {with_long("table.concat(t, a)"), "a text of more than 512 bytes"},
      {with_long("s = string.format('%s%s%s', a, a, a)"), "a text of more than 512 bytes"},
      {with_long("error(a .. a)"), "a text of more than 512 bytes"},
      {"x = '" + std::string(1000, 'x') + "' function decide() end",
       "a text of more than 512 bytes"},
      {"x = 1" + std::string(300'000, ' ') + "function decide() end",
       "has 300026 bytes, a script may have 262144"},
      {deciding("local function f() return 1 + f() end f()"), "calls itself too often"},
      {deciding("local function f(...) return f(1, 2, 3, 4, 5, 6, 7, 8, 9, ...) end f()"),
       "passes too many values at once"},
      {with_long("for i = 1, 2000 do t[i] = 1 end table.sort(t)"), "longer than 1000"},
      {with_long("table.unpack(t, 1, 1e6)"), "more than 1000 elements"},
      {with_long("table.unpack(t, math.mininteger, math.maxinteger)"), "more than 1000 elements"},
  });
}

TEST(HostileScripts, that_look_for_an_address_find_none) {
  for (const char* format : {"%p", "%20p", "%-p", "%-20.5p", "%d %%%p", "x%p"}) {
    expect_ends({{deciding("log(string.format('" + std::string{format} + "', 'abc'))"),
                  "%p is an address"}});
  }
  expect_ends({
      {deciding("log(string.format('%s', {}))"), "has no text that would be the same in each run"},
      {deciding("log(('%s'):format(log))"), "has no text that would be the same in each run"},
      {deciding("log('' .. {})"), "attempt to concatenate a table value"},
      {deciding("for k in pairs({[{}] = 1}) do end"), "has no order that would be the same"},
      {deciding("for k in pairs({[decide] = 1}) do end"), "has no order that would be the same"},
      {deciding("do return {[decide] = 1} end"), "a key that is no knob's name"},
  });
}

TEST(HostileScripts, that_reach_for_what_is_not_there_get_nothing) {
  expect_ends({
      {deciding("os.execute('true')"), "global 'os'"},
      {deciding("io.open('/etc/passwd')"), "global 'io'"},
      {deciding("debug.sethook()"), "global 'debug'"},
      {deciding("require('socket')"), "global 'require'"},
      {deciding("load('x = 1')()"), "global 'load'"},
      {deciding("setmetatable({}, {})"), "global 'setmetatable'"},
      {deciding("coroutine.wrap(decide)()"), "global 'coroutine'"},
      {deciding("pcall(decide)"), "global 'pcall'"},
      {deciding("collectgarbage('stop')"), "global 'collectgarbage'"},
      {deciding("s = ('x'):rep(1e9)"), "method 'rep'"},
      {deciding("s = ('x'):gsub('x', '')"), "method 'gsub'"},
      {deciding("s = string.pack('s', 'x')"), "field 'pack'"},
      {deciding("s = '10' + 1"), "attempt to perform arithmetic on a string value"},
      {deciding("s = string.char(0)"), "a text with a zero byte"},
      {deciding("s = string.format('%c', 0)"), "a text with a zero byte"},
      {"x = '\\0' function decide() end", "mine.lua:1: a text with a zero byte"},
      {"\x1bLua" + deciding(""), "attempt to load a binary chunk"},
  });
}

TEST(HostileScripts, that_answer_nonsense_are_told_so) {
  expect_ends({
      {deciding("do return 1 end"), "must return a table of wishes"},
      {deciding("do return {['map.range_m'] = '1'} end"), "gives no number for \"map.range_m\""},
      {deciding("do return {['map.zoom'] = 1} end"),
       "names a knob that does not exist: \"map.zoom\""},
      {deciding("do return {[1] = 1} end"), "a key that is no knob's name"},
      {deciding("do return {}, 'because' end"), "gives a reason that there is none of"},
      {deciding("error({})"), "raised a table instead of a text"},
      {deciding("error(nil)"), "raised a nil instead of a text"},
      {"period_s = 0 / 0 function decide() end", "it must be a number of seconds, 0.001 to 3600"},
      {"parameters = {} for i = 1, 101 do parameters[i] = {name = 'p' .. i} end "
       "function decide() end",
       "parameters has more than 100"},
      {"parameters = {{name = {}}} function decide() end", "name must be a text"},
      {"decide = 3", "there is no function decide(seen)"},
  });
}

/// What a script logs depends neither on the seed of Lua's hashes nor on the clock.
TEST(HostileScripts, that_look_for_chance_see_the_same_in_each_run) {
  const std::string holes =
      "local s, sum = 12345, 0\n"
      "local function draw(n) s = (s * 1103515245 + 12345) % 2147483648 return s // 65536 % n end\n"
      "for trial = 1, 100 do\n"
      "  local t = {}\n"
      "  for i = 1, 100 do\n"
      "    local k = 1 + draw(12)\n"
      "    t[draw(3) == 0 and 'k' .. k or k] = draw(2) == 0 and 1 or nil\n"
      "  end\n"
      "  sum = (31 * sum + #t) % 1000003\n"
      "end\n"
      "function decide(seen) log(sum) return {} end";
  const std::string order =
      "local t = {} for i = 1, 900 do t[i] = {key = i < 890 and 0 or -i, place = i} end\n"
      "function decide(seen)\n"
      "  table.sort(t, function(a, b) return a.key < b.key end)\n"
      "  log(t[1].place, t[11].place, t[12].place, t[900].place, #t) return {} end";
  for (const std::string& script : {holes, order}) {
    std::string first;
    for (int run = 0; run < 12; ++run) {
      const ScratchFolder scratch;
      const auto policy = open_lua_policy(scratch.file("mine.lua", script), 1);
      ASSERT_TRUE(policy.ok()) << policy.error().message;
      ASSERT_TRUE(kit::start(**policy).ok());
      static_cast<void>((*policy)->decide({}));
      const std::string logged{kit::remark(**policy)};
      ASSERT_NE("", logged) << kit::trouble(**policy);
      first = run == 0 ? logged : first;
      EXPECT_EQ(first, logged);
    }
  }
}

}  // namespace
}  // namespace flyball
#endif
