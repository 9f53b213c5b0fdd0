// SPDX-License-Identifier: BSD-3-Clause
#include "scripts/lua_source.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::string prepared(const std::string& text) {
  const auto made = prepared_script(text);
  EXPECT_TRUE(made.ok()) << made.error().message;
  return made ? *made : "";
}

TEST(LuaSource, changes_nothing_but_length_operators) {
  EXPECT_EQ("", prepared(""));
  EXPECT_EQ("local n =  false^t + 1", prepared("local n = #t + 1"));
  EXPECT_EQ("x = a / b - c[1][ false^a[2]]", prepared("x = a / b - c[1][#a[2]]"));
}

TEST(LuaSource, leaves_texts_and_comments_alone) {
  for (const char* script : {"s = '#' -- # here\nt = \"#\\\"#\" .. 'a\\'#'", "--[[ # \n # ]] s = 1",
                             "--[==[ #]] # ]==]", "s = [[#]] .. [=[#]]#]=]", "s = 'a\\z   \n  #'",
                             "s = 'a\\\n#'", "--[=# no long comment", "s = '#", "s = [[#"}) {
    EXPECT_STREQ(script, prepared(script).c_str());
  }
  EXPECT_EQ("--[[#]] false^t", prepared("--[[#]]#t")) << "but not what follows them";
  EXPECT_EQ("s = '\n  false^t", prepared("s = '\n #t")) << "nor a text that does not end";
}

TEST(LuaSource, leaves_out_a_byte_order_mark_at_the_beginning_only) {
  EXPECT_EQ("x =  false^t", prepared("\xef\xbb\xbfx = #t"));
  EXPECT_EQ("", prepared("\xef\xbb\xbf"));
  EXPECT_EQ("x = 1 \xef\xbb\xbf", prepared("x = 1 \xef\xbb\xbf"));
}

TEST(LuaSource, leaves_out_a_first_line_for_the_shell_but_not_its_end) {
  EXPECT_EQ("\nx =  false^t", prepared("#!/usr/bin/env lua\nx = #t"));
  EXPECT_EQ("\nx = 1", prepared("\xef\xbb\xbf#!/usr/bin/lua \"it's\" [[\nx = 1"));
  EXPECT_EQ("", prepared("#!/usr/bin/lua"));
  EXPECT_EQ("x = 1\n false^!/usr/bin/lua", prepared("x = 1\n#!/usr/bin/lua"));
}

TEST(LuaSource, refuses_zero_bytes_by_their_line) {
  using namespace std::string_literals;
  for (const std::string& text : {"s = '\0'"s, "s = '\\0'"s, "s = '\\0a'"s, "s = '\\00x'"s,
                                  "s = '\\000'"s, "s = '\\x00'"s, "s = '\\u{000}'"s, "--\0"s}) {
    const auto refused = prepared_script("x = 1\n" + text);
    ASSERT_FALSE(refused.ok()) << text;
    EXPECT_EQ("2: a text with a zero byte is not allowed here", refused.error().message);
  }
  for (const std::string& text : {"s = '\\065\\x0a\\u{1f600}\\\\0'"s, "s = [[\\0]]"s, "-- \\0"s}) {
    EXPECT_EQ(text, prepared(text));
  }
}

}  // namespace
}  // namespace flyball
