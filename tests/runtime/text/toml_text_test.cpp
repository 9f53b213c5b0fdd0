// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/text/toml_text.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// 0: the text may be read.
int line_of_fault(std::string_view text) {
  const auto fault = fault_of_toml(text);
  EXPECT_TRUE(!fault || !fault->what.empty());
  return fault ? fault->line : 0;
}

TEST(TomlText, lets_through_whatever_may_stand_in_toml) {
  for (const std::string_view text :
       {"", "a = 1", "[a]\nb = [1, 2]", "[[a]]\n[ [1] ]", "[ \"a\" . 'b' ]", "['ä']\n\"ö\" = 'ü'",
        "# äöü [=\na = 1 # ü", "a = \"\"\"\n[=\nä\\\"\"\"\"\n", "a = '''\n[=\nä'''",
        "\xef\xbb\xbf"
        "a = 1",
        "a = [\n[1],\n[ -1 ],\n[ 'x' ]\n]\n", "a = [\n  [+1]\n]\n[b]", "a = {b = [\n[.5]]}", "[]",
        "[", "a = \"\\\"ä\"", "a = 'C:\\'\n[b]"}) {
    EXPECT_EQ(0, line_of_fault(text)) << text;
  }
}

TEST(TomlText, finds_letters_that_are_not_quoted) {
  EXPECT_EQ(1, line_of_fault("mäßig = 1"));
  EXPECT_EQ(2, line_of_fault("a = 1\nb = 3.33\xcc\x9e-6\n"));
  EXPECT_EQ(3, line_of_fault("a = '''\nä'''\nb = ü"));
  EXPECT_EQ(2, line_of_fault("a = \"broken off\nb = ü"));
  EXPECT_EQ(1, line_of_fault("[ä]"));
  EXPECT_EQ(1, line_of_fault("a = 1\xc2\xa0"));
}

TEST(TomlText, finds_quotation_marks_that_toml_plus_plus_takes_for_a_part_of_a_value) {
  EXPECT_EQ(1, line_of_fault("a = 0y\"½\""));
  EXPECT_EQ(2, line_of_fault("\na = 1.'½'"));
  EXPECT_EQ(1, line_of_fault("a = +'½'"));
  EXPECT_EQ(1, line_of_fault(std::string_view{"a=2\0\"\xef\xbb\xaf\"", 9}));
  for (const std::string_view text : {"a = \"b\"'½'", "a = ['b']'½'", "a = {}\"½\"", "a = 1$'½'"}) {
    EXPECT_EQ(1, line_of_fault(text)) << text;
  }
  for (const std::string_view text :
       {"a.\"b c\" = 1", "[\"ä\"]", "a=['b','c']", "a={'b'='c'}\r\n'd'=1", "a = [\n'b'\n]"}) {
    EXPECT_EQ(0, line_of_fault(text)) << text;
  }
}

TEST(TomlText, finds_letters_that_toml_plus_plus_takes_for_blanks_behind_a_backslash) {
  EXPECT_EQ(1, line_of_fault("a = \"\"\"2\\\\\\é\"\"\""));
  EXPECT_EQ(2, line_of_fault("\na = \"\"\"\\  é\"\"\""));
  EXPECT_NE(0, line_of_fault("a = \"\"\"one \\\r\n \t\n é\"\"\""));
  EXPECT_EQ(0, line_of_fault("a = \"\"\"one \\\n two é \\n é \\\\ é\"\"\""));
  EXPECT_EQ(0, line_of_fault("a = '''\\é'''"));
}

TEST(TomlText, lets_long_texts_end_with_quotation_marks_of_their_own) {
  for (const std::string_view text :
       {"a = \"\"\"x\"\"\"\"", "a = \"\"\"x\"\"\"\"\"", "a = '''x'''''"}) {
    EXPECT_EQ(0, line_of_fault(text)) << text;
  }
}

TEST(TomlText, finds_dates_behind_which_toml_plus_plus_expects_a_time) {
  EXPECT_EQ(1, line_of_fault("a = [1979-05-27 3, 4]"));
  EXPECT_EQ(2, line_of_fault("\na=1_979-05-27 3\n"));
  EXPECT_EQ(1, line_of_fault("a = [3-e3-e3-ex 3,"));
  EXPECT_EQ(0,
            line_of_fault("a = [1979-05-27, 3, 4]\nb = 1979-05-27 07:32:00\nc = 1979-05-27 # 3\n"));
}

TEST(TomlText, finds_bare_values_that_no_value_can_be) {
  EXPECT_EQ(1, line_of_fault("g=0='\xef\xbb\x9f "));
  EXPECT_EQ(2, line_of_fault("\non_m = 0.U^['ZZ^^\x10_ssc^^^\xef\xb9\xbf"
                             "32\n"));
  EXPECT_EQ(1, line_of_fault("a = 1979-05-27 0='é'"));
  for (const std::string_view text :
       {"a = [0='é']", "a = [1, 2='é']", "a = [\n1\n,2['é']", "a = {b=1{'é'"}) {
    EXPECT_NE(0, line_of_fault(text)) << text;
  }
  EXPECT_EQ(0, line_of_fault(
                   "a = -1.5e+3\nb = 0x_fF\nc = true\nd = [+inf, nan,\n 1_000 ]\ne = 07:32:00.5\n"
                   "f = {g = [1,2], h = 3}\ni.j=4\n'k' = 'é'\n[l]\nm = [{n = 1}, {o = 'é'}]\n"));
}

TEST(TomlText, finds_lists_that_end_as_tables_do) {
  EXPECT_EQ(2, line_of_fault("a = [\n}"));
  EXPECT_EQ(1, line_of_fault("a = {b = [[}"));
  EXPECT_EQ(0, line_of_fault("a = {b = [{c = 1}, {}]}"));
}

TEST(TomlText, finds_names_of_too_many_parts) {
  std::string parts;
  for (int i = 0; i < 15; ++i) {
    parts += i % 2 == 0 ? "a . " : "'b'.";
  }
  EXPECT_EQ(0, line_of_fault(parts + "a = 1.5\n" + parts + "b = 2.5"));
  EXPECT_EQ(0, line_of_fault("[" + parts + "a]\nb = {" + parts + "c = 1, " + parts + "d = 2}"));
  EXPECT_EQ(1, line_of_fault(parts + "b.a = 1"));
  EXPECT_EQ(2, line_of_fault("\n[[" + parts + "b.a]]"));
  EXPECT_EQ(1, line_of_fault("a = {" + parts + "b.a = 1}"));
}

TEST(TomlText, finds_tables_whose_name_begins_with_no_letter) {
  using namespace std::string_view_literals;
  for (const auto text : {"[\0]"sv, "[=]"sv, "[.a]"sv, "[[ .a]]"sv, "a = [1]\n [\n"sv, "[[["sv,
                          "a = {}\n[{"sv, "# [\n[#"sv, "a = ']'\n[*]"sv}) {
    EXPECT_NE(0, line_of_fault(text)) << text;
  }
  EXPECT_EQ(3, line_of_fault("[a]\n\n [ =]"));
  EXPECT_EQ(1, line_of_fault("\xef\xbb\xbf[#"));
}

}  // namespace
}  // namespace flyball
